import { useEffect, useState } from "preact/hooks";
import { sentence_of } from "../backend";
import { kChoices, kUsual, question_of, Slider } from "../choices";
import { load_isolated } from "../serial/isolation";
import { choose_port, port_names, web_serial } from "../serial/serial_ports";
import type { Robot } from "./robot";

interface Port {
  path: string;
  what: string;
}

interface Props {
  robot: Robot;
  busy: boolean;
  open: (question: { port: string }) => void;
}

interface Attempting extends Props {
  /** Does it, and shows why it cannot be done. */
  attempt: (what: () => Promise<unknown>) => void;
}

/** A robot at a cable: at a port of the program that serves this page, or of the browser. */
export function RealRobot(props: Props) {
  const [problem, set_problem] = useState("");
  const attempt = (what: () => Promise<unknown>) => {
    set_problem("");
    // A person who chooses no port knows it.
    what().catch((error: unknown) => (error as Error).name !== "NotFoundError" && set_problem(sentence_of(error)));
  };
  return (
    <article aria-label="A robot at this computer">
      <h2>A robot at this computer</h2>
      <WayToIt {...props} attempt={attempt} />
      {problem && <p role="alert" class="problem">{problem}</p>}
    </article>
  );
}

function WayToIt(props: Attempting) {
  const { robot, attempt } = props;
  if (robot.backend.has_ports)
    return <Ports {...props} none="There is no serial port with a robot. Plug in its cable and switch it on."
      list={async () => (await robot.backend.ask<{ ports: Port[] }>("robot/ports", {})).ports} />;
  if (!isSecureContext || !web_serial())
    return (
      <p>
        {isSecureContext ? "This browser gives a page no serial port; current Chrome, Edge and Firefox do." : "Browsers give serial ports only to pages from https or from this computer."}{" "}
        The same page reaches robots from any browser when Astrolabe, installed on your computer, serves it.
      </p>
    );
  if (!crossOriginIsolated)
    return (
      <>
        <p>Over a USB cable, with nothing installed. The page loads anew once for it.</p>
        <button type="button" class="outline" onClick={() => attempt(load_isolated)}>Use a serial port</button>
      </>
    );
  return <Ports {...props} none="Plug in its cable, switch it on, and choose its port."
    list={async () => (await port_names()).map((path) => ({ path, what: "chosen before" }))} choose={choose_port} />;
}

/** `choose`: has a person choose another port, where the browser asks for it. */
function Ports(props: Attempting & { list: () => Promise<Port[]>; choose?: () => Promise<string>; none: string }) {
  const { choose, open, attempt } = props;
  const [ports, set_ports] = useState<Port[] | null>(null);
  const look = () => attempt(async () => set_ports(await props.list()));
  useEffect(() => {
    look();
    const changes = ["connect", "disconnect"];
    changes.forEach((each) => web_serial()?.addEventListener(each, look));
    return () => changes.forEach((each) => web_serial()?.removeEventListener(each, look));
  }, []);
  const choose_and_open = async (choose: () => Promise<string>) => {
    const port = await choose();
    look();
    open({ port });
  };
  return (
    <>
      {ports?.map(({ path, what }) => (
        <button type="button" class="port" key={path} disabled={props.busy} onClick={() => open({ port: path })}>
          {path} <small>{what}</small>
        </button>
      ))}
      {ports?.length === 0 && <p>{props.none}</p>}
      {choose ? (
        <button type="button" disabled={props.busy} onClick={() => attempt(() => choose_and_open(choose))}>Choose a port</button>
      ) : (
        <button type="button" class="outline" onClick={look}>Look again</button>
      )}
    </>
  );
}

function Simulated({ busy, open }: { busy: boolean; open: (question: object) => void }) {
  const [chosen, choose] = useState(kUsual);
  return (
    <article aria-label="A simulated robot">
      <h2>A simulated robot</h2>
      <p>It runs the firmware of a real one, and its wheels are a little off, so that odometry and truth part.</p>
      <details>
        <summary>How it is built</summary>
        {kChoices.map((each) => (
          <Slider key={each.name} choice={each} value={chosen[each.name]!} disabled={busy} set={(value) => choose({ ...chosen, [each.name]: value })} />
        ))}
      </details>
      <button type="button" disabled={busy} aria-busy={busy} onClick={() => open({ simulated: question_of(chosen) })}>
        Simulate a robot
      </button>
    </article>
  );
}

/** Which robot is to be watched. */
export function Connect({ robot }: { robot: Robot }) {
  const [busy, set_busy] = useState(false);
  const [problem, set_problem] = useState("");
  const open = async (question: object) => {
    set_busy(true);
    set_problem("");
    try {
      await robot.open(question);
    } catch (error) {
      set_problem(sentence_of(error));
    }
    set_busy(false);
  };
  return (
    <>
      <h1>Watch and drive a robot</h1>
      {problem && <p role="alert" class="problem">{problem}</p>}
      <div class="robots">
        <RealRobot robot={robot} busy={busy} open={(question) => void open(question)} />
        <Simulated busy={busy} open={(question) => void open(question)} />
      </div>
    </>
  );
}

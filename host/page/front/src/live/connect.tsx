import { useEffect, useState } from "preact/hooks";
import { sentence_of } from "../backend";
import { kChoices, kUsual, question_of, Slider } from "../choices";
import type { Robot } from "./robot";

interface Port {
  path: string;
  what: string;
}

export function Ports({ robot, busy, open }: { robot: Robot; busy: boolean; open: (question: object) => void }) {
  const [ports, set_ports] = useState<Port[] | null>(null);
  const [problem, set_problem] = useState("");
  const look = () => {
    set_problem("");
    robot.backend.ask<{ ports: Port[] }>("robot/ports", {}).then((answer) => set_ports(answer.ports), (error) => set_problem(sentence_of(error)));
  };
  useEffect(look, []);
  return (
    <article aria-label="A robot at this computer">
      <h2>A robot at this computer</h2>
      {ports?.map(({ path, what }) => (
        <button type="button" class="port" key={path} disabled={busy} onClick={() => open({ port: path })}>
          {path} <small>{what}</small>
        </button>
      ))}
      {ports?.length === 0 && <p>There is no serial port with a robot. Plug in its cable and switch it on.</p>}
      {problem && <p role="alert" class="problem">{problem}</p>}
      <button type="button" class="outline" onClick={look}>Look again</button>
    </article>
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
        {robot.backend.has_ports && <Ports robot={robot} busy={busy} open={(question) => void open(question)} />}
        <Simulated busy={busy} open={(question) => void open(question)} />
        {!robot.backend.has_ports && (
          <article>
            <h2>A real robot</h2>
            <p>This page, as it comes from a web server, reaches no cable. The same page reaches robots at your computer when Astrolabe, installed there, serves it.</p>
          </article>
        )}
      </div>
    </>
  );
}

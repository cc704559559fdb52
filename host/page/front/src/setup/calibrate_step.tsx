import { useEffect, useRef, useState } from "preact/hooks";
import type { Event_ } from "../backend";
import { type Factors, FactorTable } from "../factors";
import type { Robot } from "../live/robot";
import { type Way, Ways } from "../ways";
import { parameter, type Values } from "./put_in_force";
import { Problem, type StepProps, use_work, Verdict } from "./step";
import { kSimulator, kTruths } from "./truths";

interface Experiment {
  results: { parameters: { old: Factors; new: Factors | null; standard_errors?: Factors } };
  verdict: string;
  report: string;
}

/** What a calibration loads, as the robot has it. */
const factors_of = (robot: Robot): Values =>
  Object.fromEntries(["c_R", "c_L", "b", "e", "kappa0"].map((name) => [name, parameter(robot, name)] as const).filter(([, value]) => Number.isFinite(value)));

/** The whole experiment, with a robot that this page's module or program simulates. */
function Simulated({ robot, change, finish }: StepProps) {
  const ways = useRef<Way[]>([]);
  const [at, show] = useState("");
  const [found, take] = useState<Experiment | null>(null);
  const [report, set_report] = useState("");
  const { busy, problem, work } = use_work();
  useEffect(
    () =>
      robot.backend.listen((event: Event_) => {
        const last = ways.current.at(-1);
        if (event.event === "run") {
          ways.current.push({ phase: event.phase as string, odometry: [], truth: [] });
          show(`${event.title} (${event.number} of ${event.total})`);
        } else if (event.event === "way" && last) {
          last.odometry.push(...(event.odometry as number[]));
          last.truth.push(...(event.truth as number[]));
        }
      }),
    [],
  );
  const drive = () =>
    work(async () => {
      ways.current = [];
      take(null);
      const answer = await robot.ask_to_drive<Experiment>("robot/experiment", { runs: 3, side_m: 2 });
      set_report(await (await robot.backend.file(answer.report)).text());
      take(answer);
      await robot.read_parameters();
      change((before) => ({ ...before, loaded: { ...before.loaded, ...factors_of(robot) } }));
    });
  return (
    <>
      <p>The robot drives three squares of 2 m in each direction, is calibrated from what the cameras saw, and drives them again.</p>
      {!found && <button type="button" disabled={busy} aria-busy={busy} onClick={drive}>Drive and calibrate</button>}
      <p role="status">{busy && at}</p>
      {found && (
        <>
          <div class="phases">
            {["before", "after"].map((phase) => (
              <figure key={phase}>
                <figcaption>{phase === "before" ? "Before" : "After"} <small><span class="odometry">odometry</span> and <span class="truth">where it really is</span></small></figcaption>
                <Ways ways={ways.current.filter((way) => way.phase === phase)} label={`Ways of the drives ${phase} calibration`} />
              </figure>
            ))}
          </div>
          <FactorTable columns={[
            { title: "Loaded before", factors: found.results.parameters.old },
            { title: "Found", factors: found.results.parameters.new },
            { title: "±", factors: found.results.parameters.standard_errors },
          ]} />
          <Verdict good>
            <p>{found.verdict}</p>
            <div class="row">
              <button type="button" onClick={() => finish([found.verdict])}>Go on</button>
              <button type="button" class="secondary" onClick={drive}>Drive again</button>
            </div>
          </Verdict>
          {report && <details><summary>The report</summary><iframe srcdoc={report} title="Report" sandbox="allow-scripts" /></details>}
        </>
      )}
      <Problem sentence={problem} />
    </>
  );
}

/** What has to be typed where the ground truth is, and what it has loaded. */
function ByCommand({ robot, progress, finish }: StepProps) {
  const truth = kTruths.find((each) => each.name === progress.truth);
  const { busy, problem, work } = use_work();
  const look = () =>
    work(async () => {
      await robot.read_parameters();
      finish([`calibrated with ${truth!.what}: ${Object.entries(factors_of(robot)).map(([name, value]) => `${name} ${value}`).join(", ")}`]);
    });
  const may_stay = robot.backend.has_ports || progress.question.simulated !== undefined;
  if (!truth) return <p>First choose the ground truth, one step back.</p>;
  return (
    <>
      <p>With {truth.what} this line, typed in a terminal at this computer, drives the experiment, asks for what it needs, and loads what it finds. {may_stay ? "This page may stay open." : "Leave the robot here before, because a browser's port is for this page alone, and open it again afterwards."}</p>
      <pre class="command"><code>{may_stay ? truth.command.replace("PORT", robot.opened?.port || "PORT") : truth.command.replace("--port PORT ", "")}</code></pre>
      {!may_stay && <p><button type="button" class="secondary" disabled={busy} onClick={() => void robot.close()}>Leave the robot</button></p>}
      <button type="button" disabled={busy} aria-busy={busy} onClick={look}>It is done: read the robot</button>
      <Problem sentence={problem} />
    </>
  );
}

export function CalibrateStep(props: StepProps) {
  return props.progress.truth === kSimulator && props.progress.question.simulated ? <Simulated {...props} /> : <ByCommand {...props} />;
}

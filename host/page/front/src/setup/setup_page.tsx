import { useEffect, useState } from "preact/hooks";
import { Refusal } from "../backend";
import { Confirm } from "../live/confirm";
import { RealRobot } from "../live/connect";
import type { Opened } from "../live/contract";
import { Faults } from "../live/faults";
import type { Robot } from "../live/robot";
import { use_robot } from "../live/use_robot";
import { CalibrateStep } from "./calibrate_step";
import { CountsStep } from "./counts_step";
import { MetreStep } from "./metre_step";
import { kSteps, next_step, type Progress, type StepName, use_progress } from "./progress";
import { put_in_force, type Values } from "./put_in_force";
import { RobotStep } from "./robot_step";
import { SheetStep } from "./sheet_step";
import { SizesStep } from "./sizes_step";
import { Problem, type StepProps, use_work } from "./step";
import { TruthStep } from "./truth_step";
import { TuneStep } from "./tune_step";
import { WiresStep } from "./wires_step";

const kBodies = { wires: WiresStep, counts: CountsStep, sizes: SizesStep, tune: TuneStep, metre: MetreStep, truth: TruthStep, calibrate: CalibrateStep };

const kHere = "#setup";

/** The robot is stopped when this page goes, or another one is turned to. */
function use_stop_when_away(robot: Robot) {
  useEffect(() => {
    const hidden = () => document.hidden && location.hash === kHere && robot.leave_alone();
    const turned = ({ oldURL }: HashChangeEvent) => new URL(oldURL).hash === kHere && robot.leave_alone();
    addEventListener("hashchange", turned);
    document.addEventListener("visibilitychange", hidden);
    return () => {
      removeEventListener("hashchange", turned);
      document.removeEventListener("visibilitychange", hidden);
    };
  }, [robot]);
}

interface Question {
  sentence: string;
  decide: (yes: boolean) => void;
}

/** Loads values; what a person has to confirm becomes a question, during which nothing moves. */
function use_load(robot: Robot) {
  const [question, ask] = useState<Question | null>(null);
  const confirmed_by_person = (sentence: string) => {
    robot.leave_alone();
    return new Promise<boolean>((resolve) => ask({ sentence, decide: (yes) => (ask(null), resolve(yes)) }));
  };
  const load = async (values: Values, confirmed: boolean): Promise<boolean> => {
    try {
      await put_in_force(robot, values, confirmed);
    } catch (error) {
      if (!(error instanceof Refusal) || !error.remedies.includes("confirm")) throw error;
      if (!(await confirmed_by_person(error.message))) return false;
      await put_in_force(robot, values, true);
    }
    return true;
  };
  return { load, question };
}

function StepList({ progress, turn_to }: { progress: Progress; turn_to: (step: StepName) => void }) {
  return (
    <nav aria-label="Steps">
      <ol class="steps">
        {kSteps.slice(1).map(({ name, title }) => {
          const done = progress.done[name];
          const state = done ? (done.skipped ? "skipped" : "done") : "open";
          return (
            <li key={name} class={state}>
              <button type="button" aria-current={progress.at === name ? "step" : undefined} onClick={() => turn_to(name)}>
                {title} <small>{state === "open" ? "" : state}</small>
              </button>
            </li>
          );
        })}
      </ol>
    </nav>
  );
}

/** Whether this is the robot that is being set up. */
const is_that_of = ({ question, robot }: Progress, opened: Opened) =>
  opened.simulated ? question.simulated !== undefined : question.simulated === undefined && robot === opened.unique_id;

/** From a robot that was just built to one that is calibrated, step by step. */
export function SetupPage({ robot }: { robot: Robot }) {
  const opened = use_robot(robot, (each) => each.opened);
  const held = use_progress();
  const { load, question } = use_load(robot);
  const { busy, problem, work } = use_work();
  const [rewires, set_rewires] = useState(false);
  use_stop_when_away(robot);

  const open = async (wanted: Progress) => {
    if (!robot.opened) await robot.open(wanted.question);
    const { unique_id } = robot.opened!;
    if (!wanted.question.simulated && wanted.robot !== undefined && wanted.robot !== unique_id) throw new Refusal("Another robot answers now than the one that was being set up.");
    if (wanted.question.simulated && Object.keys(wanted.loaded).length > 0) await put_in_force(robot, wanted.loaded, true);
    held.begin({ ...wanted, robot: unique_id });
  };
  const start = (asked: Progress["question"]) => work(() => open({ question: asked, at: "wires", done: {}, loaded: {}, mended: [], truth: "" }));
  const progress = held.now;
  // Steps wait until everything is in force that was loaded before.
  const here = progress !== null && !busy && (rewires || (opened !== null && is_that_of(progress, opened)));

  if (!progress || (opened && !busy && !here))
    return (
      <>
        <h1>Set up a robot</h1>
        <p>From a robot that was just built to one that is calibrated: wires, counts, sizes, speed control, a first metre, and the calibration. Each step can be skipped, and done again later.</p>
        <RobotStep robot={robot} busy={busy} problem={problem} begin={start} />
      </>
    );
  if (!here)
    return (
      <>
        <h1>Set up a robot</h1>
        <p>You were at the step <strong>{kSteps.find((each) => each.name === progress.at)!.title}</strong> with {progress.question.simulated ? "a simulated robot" : `the robot at ${progress.question.port}`}.</p>
        <div class="row">
          <button type="button" disabled={busy} aria-busy={busy} onClick={() => work(() => open(progress))}>Go on there</button>
          <button type="button" class="secondary" disabled={busy} onClick={() => held.begin(null)}>Begin with another robot</button>
        </div>
        <Problem sentence={problem} />
        {problem && !progress.question.simulated && <RealRobot robot={robot} busy={busy} open={(at) => work(() => open({ ...progress, question: at }))} />}
      </>
    );

  const { change } = held;
  const turn_to = (at: StepName) => {
    robot.leave_alone();
    change((before) => ({ ...before, at }));
  };
  // A step that takes its time may end when another one is shown.
  const { at } = progress;
  const end = (skipped: boolean, lines: string[]) =>
    change((before) => ({ ...before, done: { ...before.done, [at]: { skipped, lines } }, at: before.at === at ? next_step(at) : before.at }));
  const rewire = async (wiring: string[]) => {
    set_rewires(true);
    try {
      const asked = { simulated: { ...held.now!.question.simulated, wiring } };
      await robot.close();
      await robot.open(asked);
      await put_in_force(robot, held.now!.loaded, true);
      change((before) => ({ ...before, question: asked }));
    } finally {
      set_rewires(false);
    }
  };
  const step: StepProps = {
    robot,
    progress,
    change,
    rewire,
    load: async (values, confirmed) => {
      if (!(await load(values, confirmed))) return false;
      change((before) => ({ ...before, loaded: { ...before.loaded, ...values } }));
      return true;
    },
    finish: (lines) => end(false, lines),
  };
  const { title } = kSteps.find((each) => each.name === progress.at)!;
  const Body = progress.at === "robot" || progress.at === "sheet" ? null : kBodies[progress.at];
  return (
    <>
      <h1>Set up {opened?.name || opened?.hardware || "a robot"}</h1>
      <div class="setup">
        <StepList progress={progress} turn_to={turn_to} />
        <section aria-label={title} class="panel" key={progress.at}>
          <h2>{title}</h2>
          <Faults robot={robot} />
          {Body ? <Body {...step} /> : <SheetStep {...step} begin_anew={() => void robot.close().then(() => held.begin(null))} />}
          {Body && (
            <p class="skip">
              <button type="button" class="outline secondary" onClick={() => (robot.leave_alone(), end(true, []))}>Skip this step</button>
            </p>
          )}
        </section>
      </div>
      {question && <Confirm sentence={question.sentence} yes="Load it all the same" decide={question.decide} />}
    </>
  );
}

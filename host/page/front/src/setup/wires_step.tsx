import { useState } from "preact/hooks";
import { RobotPicture, type Turned } from "./robot_picture";
import { changes_text, type Values } from "./put_in_force";
import { Problem, type StepProps, use_work, Verdict } from "./step";

type Side = "left" | "right";
const kSides: Side[] = ["left", "right"];

interface Seen {
  wheel: Side | null;
  forward: boolean;
}

interface Wires {
  findings: { fault: string; sentence: string }[];
  parameters: Values;
  needs_hands: boolean;
}

const kAnswers: { name: string; seen: Seen }[] = kSides.flatMap((wheel) => [
  { name: `${wheel} wheel, forward`, seen: { wheel, forward: true } },
  { name: `${wheel} wheel, backward`, seen: { wheel, forward: false } },
]);

/** The wire of a simulated robot that somebody would change because of a finding. Parameters mend what turns the wrong way. */
const wire_of = (fault: string) => (fault.endsWith("_reversed") ? "" : fault.replaceAll("_", "-").replace("channel-missing", "channel-lost"));

/** Each motor is driven by itself; the person says what turned. */
export function WiresStep({ robot, progress, change, load, rewire, finish }: StepProps) {
  const [saw, see] = useState<Partial<Record<Side, Seen>>>({});
  const [driven, set_driven] = useState<Side | null>(null);
  const [turned, set_turned] = useState<Turned | null>(null);
  const [wires, judge] = useState<Wires | null>(null);
  const { busy, problem, work } = use_work();
  const { mended } = progress;
  const simulated = progress.question.simulated;
  const next = kSides.find((side) => !saw[side]);

  const begin_anew = () => {
    see({});
    set_driven(null);
    set_turned(null);
    judge(null);
  };
  const drive = (motor: Side) =>
    work(async () => {
      set_turned(null);
      set_turned((await robot.ask_to_drive<{ turned: Turned | null }>("robot/probe_motor", { motor })).turned);
      set_driven(motor);
    });
  const answer = (seen: Seen) =>
    work(async () => {
      const all = { ...saw, [driven!]: seen };
      see(all);
      set_driven(null);
      set_turned(null);
      if (all.left && all.right) judge(await robot.backend.ask<Wires>("robot/judge_wiring", { saw: all }));
    });
  const mend = ({ findings, parameters, needs_hands }: Wires) =>
    work(async () => {
      if (Object.keys(parameters).length > 0) await load(parameters, true);
      const wrong = findings.map((each) => wire_of(each.fault));
      if (needs_hands && simulated) await rewire((simulated.wiring ?? []).filter((each) => !wrong.includes(each)));
      change((before) => ({ ...before, mended: [...before.mended, ...findings.map((each) => `mended: ${each.sentence}`)] }));
      begin_anew();
    });

  const go_on = () => {
    change((before) => ({ ...before, mended: [] }));
    finish([...mended, "motors and encoders are wired as the parameters say"]);
  };

  return (
    <>
      <p>
        Put the robot on a stand, so that both wheels hang free. Each motor is driven forward by itself, a quarter turn of its wheel,
        and you say what you saw: only who looks can tell a motor that is the wrong way round from an encoder that is.
      </p>
      <div class="wires">
        <RobotPicture turned={turned} />
        <div>
          {mended.length > 0 && !wires && (
            <Verdict good>
              <ul>{mended.map((each) => <li key={each}>{each}</li>)}</ul>
              <p>Check once more whether that was all.</p>
            </Verdict>
          )}
          {wires === null && driven === null && next && (
            <button type="button" disabled={busy} aria-busy={busy} onClick={() => drive(next)}>
              The wheels hang free: drive the {next} motor
            </button>
          )}
          {driven && (
            <fieldset disabled={busy}>
              <legend>The {driven} motor was driven forward. Which wheel turned, and which way?</legend>
              <div class="answers">
                {kAnswers.map(({ name, seen }) => (
                  <button type="button" class="outline" key={name} onClick={() => answer(seen)}>{name}</button>
                ))}
              </div>
              <div class="row">
                <button type="button" class="outline" onClick={() => answer({ wheel: null, forward: false })}>none turned</button>
                <button type="button" class="outline secondary" onClick={() => drive(driven)}>drive it once more</button>
              </div>
            </fieldset>
          )}
          {wires && wires.findings.length === 0 && (
            <Verdict good>
              <p>Motors and encoders are wired as the parameters say.</p>
              <button type="button" onClick={go_on}>Go on</button>
            </Verdict>
          )}
          {wires && wires.findings.length > 0 && (
            <Verdict good={false}>
              <ul>{wires.findings.map(({ fault, sentence }) => <li key={fault}>{sentence}</li>)}</ul>
              {Object.keys(wires.parameters).length > 0 && <p>To be loaded: {changes_text(robot, wires.parameters)}.</p>}
              {wires.needs_hands && !simulated && <p>Switch the motors' supply off before you touch the wires.</p>}
              <div class="row">
                <button type="button" disabled={busy} aria-busy={busy} onClick={() => mend(wires)}>
                  {!wires.needs_hands ? "Mend it: load them" : simulated ? "Mend it: change the wires, load the rest" : "The wires are changed: load the rest"}
                </button>
                <button type="button" class="secondary" disabled={busy} onClick={begin_anew}>Look again</button>
              </div>
            </Verdict>
          )}
          <Problem sentence={problem} />
        </div>
      </div>
    </>
  );
}

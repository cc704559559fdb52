import { useEffect, useState } from "preact/hooks";
import type { Event_ } from "../backend";
import { Problem, type StepProps, use_work, Verdict } from "./step";

interface Motor {
  kS: number;
  kV: number;
  kA: number;
  r_squared: number;
}

interface Tuning {
  wheels: { left: Motor; right: Motor };
  changes: { name: string; unit: string; before: number; after: number }[];
  follows: "better" | "same" | "worse";
  rms_before_mps: number;
  rms_now_mps: number;
  was_measured: boolean;
  unexplained: boolean;
  /** The wheel that was measured too poorly to be loaded. */
  poor: string | null;
  /** How many times the loaded kV it is, if that is not likely. */
  kV_ratio: number | null;
}

const kFollows = { better: "better than before", same: "about as well as before", worse: "worse than before" };
const mm_per_s = (value_mps: number) => `${(1000 * value_mps).toFixed(1)} mm/s`;
const sentence_of_result = ({ follows, was_measured, rms_now_mps, rms_before_mps }: Tuning) =>
  `With the new values the wheels ${was_measured ? "follow" : "should follow"} their set point ${kFollows[follows]}: rms error ${mm_per_s(rms_now_mps)}, before ${mm_per_s(rms_before_mps)}.`;

function Motors({ wheels }: Tuning) {
  return (
    <div class="wide" tabIndex={0} role="group" aria-label="Motors">
      <table>
        <thead>
          <tr>{["Wheel", "kS, V", "kV, V s/m", "kA, V s²/m", "R²"].map((each) => <th scope="col" key={each}>{each}</th>)}</tr>
        </thead>
        <tbody>
          {(["left", "right"] as const).map((side) => {
            const { kS, kV, kA, r_squared } = wheels[side];
            return (
              <tr key={side}>
                <th scope="row">{side}</th>
                <td>{kS.toFixed(2)}</td>
                <td>{kV.toFixed(2)}</td>
                <td>{kA.toFixed(2)}</td>
                <td>{r_squared.toFixed(4)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}

/** The motors are measured, and the gains that follow are loaded. */
export function TuneStep({ robot, change, finish }: StepProps) {
  const [on_stand, set_on_stand] = useState(false);
  const [done, set_done] = useState(0);
  const [found, take] = useState<Tuning | null>(null);
  const { busy, problem, work } = use_work();
  useEffect(() => robot.backend.listen((event: Event_) => event.event === "measuring" && set_done(event.done as number)), []);
  const measure = () =>
    work(async () => {
      take(null);
      set_done(0);
      take(await robot.ask_to_drive<Tuning>("robot/tune", { on_stand }));
    });
  const load = () =>
    work(async () => {
      const after = await robot.ask_to_drive<Tuning>("robot/load_tuning", {});
      take(after);
      change((before) => ({ ...before, loaded: { ...before.loaded, ...Object.fromEntries(after.changes.map((each) => [each.name, each.after])) } }));
      await robot.read_parameters();
    });
  return (
    <>
      <p>
        Both motors are measured with up to 5 V for half a minute. On the floor the robot drives straight on and back, up to 1 m to
        either side of where it stands, so keep that free. On a stand the robot's mass is missing, and fewer values are found.
      </p>
      <fieldset disabled={busy}>
        <legend>Where is the robot?</legend>
        <label><input type="radio" name="where" checked={!on_stand} onChange={() => set_on_stand(false)} />It is on the floor</label>
        <label><input type="radio" name="where" checked={on_stand} onChange={() => set_on_stand(true)} />Its wheels hang free</label>
      </fieldset>
      {!found && (
        <button type="button" disabled={busy} aria-busy={busy} onClick={measure}>
          {on_stand ? "The wheels may turn: measure" : "The floor is free: measure"}
        </button>
      )}
      {busy && <progress value={done} max={1} aria-label="Part of the measurement that is done" />}
      {found && (
        <>
          <Motors {...found} />
          <Verdict good={found.follows !== "worse" && !found.poor}>
            <p>{sentence_of_result(found)}</p>
            {found.kV_ratio && <p>kV is {found.kV_ratio.toFixed(2)} times the value that was loaded: other motors or wheels, or wrong counts per turn.</p>}
            {found.poor && <p>The {found.poor} wheel was measured too poorly for its values to be loaded: measure again with more room.</p>}
            {found.unexplained && <p>The model explains less than half of it: look for slip, play or a weak supply.</p>}
            {!found.was_measured && found.changes.length > 0 && (
              <p>To be loaded: {found.changes.map(({ name, before, after }) => `${name} ${before} → ${after}`).join(", ")}.</p>
            )}
            <div class="row">
              {found.was_measured || found.changes.length === 0 ? (
                <button type="button" onClick={() => finish([sentence_of_result(found)])}>Go on</button>
              ) : (
                <button type="button" disabled={busy || found.poor !== null} aria-busy={busy} onClick={load}>Load them and drive the step again</button>
              )}
              <button type="button" class="secondary" disabled={busy} onClick={measure}>Measure again</button>
            </div>
          </Verdict>
        </>
      )}
      <Problem sentence={problem} />
    </>
  );
}

import { useState } from "preact/hooks";
import { DrivePad } from "./drive_pad";
import type { Robot } from "./robot";
import { use_robot } from "./use_robot";

const kPaths = ["line", "square", "circle"];
const kDirections: Record<string, string> = { forward: "forward", backward: "backward", ccw: "to the left", cw: "to the right" };

function PathForm({ robot, drives }: { robot: Robot; drives: boolean }) {
  const [kind, set_kind] = useState("square");
  const [size_m, set_size] = useState(1);
  const [direction, set_direction] = useState("");
  const directions = kind === "line" ? ["forward", "backward"] : ["ccw", "cw"];
  const done = use_robot(robot, (each) => each.path_done);
  const mode = use_robot(robot, (each) => each.state?.mode);
  return (
    <form class="settings" aria-label="A path" onSubmit={(event) => { event.preventDefault(); void robot.command("robot/path", { kind, size_m, direction: directions.includes(direction) ? direction : directions[0] }); }}>
      <label>
        Path
        <select value={kind} onChange={(event) => set_kind(event.currentTarget.value)}>
          {kPaths.map((each) => <option key={each}>{each}</option>)}
        </select>
      </label>
      <label>
        {kind === "circle" ? "Radius, m" : kind === "line" ? "Length, m" : "Side, m"}
        <input type="number" min="0.05" max="20" step="any" required value={size_m} onInput={(event) => set_size(Number(event.currentTarget.value))} />
      </label>
      <label>
        Direction
        <select value={directions.includes(direction) ? direction : directions[0]} onChange={(event) => set_direction(event.currentTarget.value)}>
          {directions.map((each) => <option key={each} value={each}>{kDirections[each]}</option>)}
        </select>
      </label>
      <button type="submit" class="outline" disabled={!drives || done !== null}>Drive it</button>
      {mode === "paused" ? (
        <button type="button" class="outline" onClick={() => void robot.command("robot/resume")}>Go on</button>
      ) : (
        <button type="button" class="outline" disabled={done === null} onClick={() => void robot.command("robot/pause")}>Pause</button>
      )}
      {done !== null && <progress value={done} max={1} aria-label="Part of the path that is driven" />}
    </form>
  );
}

/** Arming, the pad and paths. */
export function Driving({ robot }: { robot: Robot }) {
  const state = use_robot(robot, (each) => each.state);
  const lost = use_robot(robot, (each) => each.lost);
  const drives = use_robot(robot, (each) => each.drives), is_mine = use_robot(robot, (each) => each.is_mine);
  const usable = lost === "" && state !== null;
  return (
    <section aria-label="Drive" class="panel">
      <div class="head">
        <h2>Drive</h2>
        <span class="spring" />
        <button type="button" class="outline" disabled={!usable || !state.armed} onClick={() => void robot.stop()}>
          Stop
        </button>
        {state?.armed && (
          <button type="button" class="secondary" disabled={!usable} onClick={() => void robot.command("robot/disarm")}>
            Disarm
          </button>
        )}
        {!drives && (
          <button type="button" disabled={!usable || state.faults.length > 0} onClick={() => void robot.arm()}>
            {is_mine ? "Arm again" : "Arm"}
          </button>
        )}
      </div>
      {state?.other_driver && <p role="status">{state.other_driver}</p>}
      {state && state.driver !== 0 && !is_mine && <p role="status">Another page drives the robot. This one can watch it, and stop it.</p>}
      <DrivePad robot={robot} />
      <PathForm robot={robot} drives={drives} />
    </section>
  );
}

import { useEffect } from "preact/hooks";
import { sentence_of } from "../backend";
import { value_text } from "./nice";
import type { Robot } from "./robot";
import { use_robot } from "./use_robot";

const kModes: Record<string, string> = { idle: "armed", velocity: "driving", segment: "on a path", wheels: "open loop" };
/** What Space does in these is of use and moves no robot. */
const kTakeSpace = "input:is([type=text], [type=search], [type=checkbox], [type=radio], [type=file]), textarea, select, summary";

/** Space stops the robot whatever has the focus: it never presses a button. In a field it is a space as long as the robot is not armed. */
function use_space_stops(robot: Robot, open: boolean) {
  useEffect(() => {
    if (!open) return;
    const take = (event: KeyboardEvent) => {
      if (event.code !== "Space" && event.key !== " ") return;
      const field = event.target instanceof Element && event.target.matches(kTakeSpace);
      if (field && !robot.state?.armed) return;
      // A button is pressed when the key is let go.
      event.preventDefault();
      event.stopPropagation();
      if (event.type === "keydown" && !event.repeat) void robot.emergency_stop();
    };
    addEventListener("keydown", take, true);
    addEventListener("keyup", take, true);
    return () => {
      removeEventListener("keydown", take, true);
      removeEventListener("keyup", take, true);
    };
  }, [open]);
}

/** The open robot in a line, with its emergency stop; on every page. */
export function Strip({ robot }: { robot: Robot }) {
  const opened = use_robot(robot, (each) => each.opened);
  const state = use_robot(robot, (each) => each.state);
  const lost = use_robot(robot, (each) => each.lost);
  const refusal = use_robot(robot, (each) => each.refusal);
  use_space_stops(robot, opened !== null);
  if (!opened) return null;
  const look = lost ? "lost" : state && state.faults.length > 0 ? "fault" : state?.moving ? "moving" : state?.armed ? "armed" : "off";
  return (
    <div class={`strip ${look}`} role="region" aria-label="Robot">
      <div class="container">
        <div class="facts">
          <strong>{opened.name || opened.hardware}</strong>
          <span class="mode">{lost ? "lost" : (kModes[state?.mode ?? ""] ?? state?.mode ?? "…")}</span>
          {typeof state?.battery_V === "number" && <span class="battery">{value_text(state.battery_V)} V</span>}
          {state?.recording && <span class="recording">recording</span>}
          <small>{opened.hardware}, {opened.firmware}</small>
        </div>
        <button type="button" class="emergency" aria-keyshortcuts="Space" onClick={() => void robot.emergency_stop()}>
          STOP <small>space bar</small>
        </button>
        {lost && <p role="alert">{lost} A robot that hears nothing stops by itself.</p>}
        {refusal !== null && (
          <p role="alert" class="refusal">
            {sentence_of(refusal)}
            <button type="button" class="outline" aria-label="Close this message" onClick={() => robot.refuse(null)}>×</button>
          </p>
        )}
      </div>
    </div>
  );
}

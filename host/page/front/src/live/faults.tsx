import type { Robot } from "./robot";
import { use_robot } from "./use_robot";
import { words } from "./words";

/** What keeps the robot from driving, and what helps. */
export function Faults({ robot }: { robot: Robot }) {
  const faults = use_robot(robot, (each) => each.state)?.faults ?? [];
  if (faults.length === 0) return null;
  return (
    <section aria-label="Faults" class="panel faults">
      <div class="head">
        <h2 role="alert">{faults.length === 1 ? "A fault holds the robot" : `${faults.length} faults hold the robot`}</h2>
        <span class="spring" />
        <button type="button" onClick={() => void robot.command("robot/clear_faults")}>
          Clear
        </button>
      </div>
      <dl>
        {faults.map((each) => (
          <div key={each.name}>
            <dt>{words(each.name)}</dt>
            <dd>{each.remedy}</dd>
          </div>
        ))}
      </dl>
    </section>
  );
}

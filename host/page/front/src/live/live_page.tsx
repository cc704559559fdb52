import { Connect } from "./connect";
import { Driving } from "./driving";
import { Faults } from "./faults";
import { Parameters } from "./parameters";
import { PathView } from "./path_view";
import { Recordings } from "./recordings";
import { kWheelSignals, type Robot } from "./robot";
import { Scope } from "./scope";
import { use_robot } from "./use_robot";
import { Wheels } from "./wheels";

/** A robot as it drives, and whoever drives it. */
export function LivePage({ robot }: { robot: Robot }) {
  const opened = use_robot(robot, (each) => each.opened);
  if (!opened)
    return (
      <>
        <Connect robot={robot} />
        <Recordings robot={robot} />
      </>
    );
  return (
    <>
      <div class="head">
        <h1>{opened.name || opened.hardware}</h1>
        <span class="spring" />
        <button type="button" class="outline secondary" onClick={() => void robot.close()}>
          Leave this robot
        </button>
      </div>
      <Faults robot={robot} />
      <Recordings robot={robot} />
      <div class="cockpit">
        <PathView robot={robot} />
        <div>
          <Driving robot={robot} />
          <Wheels robot={robot} />
        </div>
      </div>
      <Scope robot={robot} usual={kWheelSignals} />
      <Parameters robot={robot} />
    </>
  );
}

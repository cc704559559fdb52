import { useRef } from "preact/hooks";
import type { Robot } from "./robot";
import { use_frames, use_robot } from "./use_robot";

const kReadEvery_ms = 100;
const kSides = ["left", "right"] as const;

const speed_text = (value: number) => (Number.isNaN(value) ? "–" : value.toFixed(3).replace("-", "−"));

/** A bar from the middle, of a value from -1 to 1. */
function set_bar(bar: HTMLElement, value: number) {
  const part = Math.max(-1, Math.min(1, Number.isNaN(value) ? 0 : value));
  bar.style.transform = `scaleX(${part})`;
}

function Wheel({ robot, side, most_mps }: { robot: Robot; side: string; most_mps: number }) {
  const row = useRef<HTMLDivElement>(null);
  const written_ms = useRef(0);
  const show = () => {
    if (!row.current) return;
    const value = (what: string) => robot.latest.get(`${side}_${what}`) ?? NaN;
    const part = (selector: string) => row.current!.querySelector<HTMLElement>(selector)!;
    const [speed, wanted, duty] = [value("speed"), value("setpoint"), value("duty")];
    set_bar(part(".speed i"), speed / most_mps);
    set_bar(part(".duty i"), duty);
    part(".speed b").style.transform = `translateX(${50 * Math.max(-1, Math.min(1, (wanted || 0) / most_mps))}%)`;
    // Nobody reads faster, and each number has the browser lay out the page again.
    if (performance.now() - written_ms.current < kReadEvery_ms) return;
    written_ms.current = performance.now();
    part(".speed data").textContent = speed_text(speed);
    part(".speed small data").textContent = speed_text(wanted);
    part(".duty data").textContent = Number.isNaN(duty) ? "–" : `${Math.round(100 * duty)}`.replace("-", "−");
  };
  use_frames(robot, () => {}, show);
  return (
    <div ref={row} class="wheel">
      <h3>{side === "left" ? "Left" : "Right"}</h3>
      <div class="speed">
        <span>speed <span class="value"><data>–</data> m/s</span> <small>set point <data>–</data></small></span>
        <div class="bar"><i /><b /></div>
      </div>
      <div class="duty">
        <span>duty <span class="value"><data>–</data> %</span></span>
        <div class="bar"><i /></div>
      </div>
    </div>
  );
}

/** What both wheels do, and what they are told to. */
export function Wheels({ robot }: { robot: Robot }) {
  const limit = use_robot(robot, (each) => each.parameters.find(({ name }) => name === "speed_limit")?.value);
  return (
    <section aria-label="Wheels" class="panel">
      <h2>Wheels</h2>
      {kSides.map((side) => (
        <Wheel key={side} robot={robot} side={side} most_mps={typeof limit === "number" ? limit : 1} />
      ))}
    </section>
  );
}

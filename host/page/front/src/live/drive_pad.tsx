import { useEffect, useRef, useState } from "preact/hooks";
import type { Robot } from "./robot";
import { use_robot } from "./use_robot";

const kArrows: Record<string, [number, number]> = { ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1] };
/** Slow enough that nobody is frightened; a slider makes it faster. */
const kGentle = { speed_mps: 0.2, turn_radps: 0.8 };

function use_limit(robot: Robot, parameter: string, otherwise: number): number {
  const value = use_robot(robot, (each) => each.parameters.find(({ name }) => name === parameter)?.value);
  return typeof value === "number" ? value : otherwise;
}

const sum = (all: number[]) => all.reduce((a, b) => a + b, 0);

function Most(props: { label: string; unit: string; most: number; value: number; set: (value: number) => void }) {
  return (
    <label>
      {props.label} <data>{props.value.toFixed(2)}</data> {props.unit}
      <input type="range" min={props.most / 20} max={props.most} step="any" value={props.value} onInput={(event) => props.set(Number(event.currentTarget.value))} />
    </label>
  );
}

/** Drives the robot as long as it is held, with a pointer or with the arrow keys. */
export function DrivePad({ robot }: { robot: Robot }) {
  const drives = use_robot(robot, (each) => each.drives);
  const speed_limit = use_limit(robot, "speed_limit", 0.5), turn_limit = use_limit(robot, "yaw_rate_limit", 2);
  const [most, set_most] = useState(kGentle);
  const [knob, set_knob] = useState<[number, number]>([0, 0]);
  const pad = useRef<HTMLDivElement>(null);
  const pointer = useRef<number | null>(null);
  const keys = useRef(new Set<string>());

  const steer = (forward: number, left: number) => {
    if (!drives || robot.path_done !== null) return;
    set_knob([forward, left]);
    robot.drive.hold({ v_mps: forward * Math.min(most.speed_mps, speed_limit), w_radps: left * Math.min(most.turn_radps, turn_limit) });
  };
  const let_go = () => {
    pointer.current = null;
    keys.current.clear();
    set_knob([0, 0]);
  };
  const release = () => {
    let_go();
    robot.drive.release();
  };
  /** Whatever took the pad away from whoever held it, they may not know that the robot drives. */
  const abandon = () => {
    let_go();
    robot.abandon();
  };
  const point = (event: PointerEvent) => {
    const { left, top, width, height } = pad.current!.getBoundingClientRect();
    const [x, y] = [(2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height];
    const far = Math.max(1, Math.hypot(x, y));
    steer(y / far, -x / far);
  };
  const press = (event: PointerEvent) => {
    if (pointer.current !== null || event.button !== 0 || keys.current.size > 0) return;
    pad.current!.focus();
    pad.current!.setPointerCapture(event.pointerId);
    pointer.current = event.pointerId;
    point(event);
  };
  const key = (event: KeyboardEvent, down: boolean) => {
    if (!(event.key in kArrows) || pointer.current !== null) return;
    event.preventDefault();
    if (event.repeat) return;
    if (down) keys.current.add(event.key);
    else if (!keys.current.delete(event.key)) return;
    if (keys.current.size === 0) return release();
    const pressed = [...keys.current].map((each) => kArrows[each]!);
    steer(sum(pressed.map(([forward]) => forward)), sum(pressed.map(([, left]) => left)));
  };
  const newest_abandon = useRef(abandon);
  newest_abandon.current = abandon;
  useEffect(() => {
    const leave = () => newest_abandon.current();
    const hide = () => document.hidden && leave();
    addEventListener("blur", leave);
    addEventListener("pagehide", leave);
    document.addEventListener("visibilitychange", hide);
    return () => {
      removeEventListener("blur", leave);
      removeEventListener("pagehide", leave);
      document.removeEventListener("visibilitychange", hide);
      leave();
    };
  }, []);
  const [forward, left] = drives ? knob : [0, 0];
  const mine = (event: PointerEvent) => event.pointerId === pointer.current;

  return (
    <div class="pad-and-limits">
      <div ref={pad} class="pad" tabIndex={0} role="application" aria-disabled={!drives}
        aria-label="Drive pad: hold the arrow keys to drive"
        onPointerDown={press} onPointerMove={(event) => mine(event) && point(event)} onPointerUp={(event) => mine(event) && release()}
        onPointerCancel={(event) => mine(event) && abandon()} onLostPointerCapture={(event) => mine(event) && abandon()}
        onKeyDown={(event) => key(event, true)} onKeyUp={(event) => key(event, false)} onBlur={abandon} onContextMenu={(event) => event.preventDefault()}>
        {["▲", "▼", "◀", "▶"].map((arrow) => <span aria-hidden="true" class="arrow" key={arrow}>{arrow}</span>)}
        <span aria-hidden="true" class="knob" style={{ transform: `translate(calc(-50% + ${-left} * var(--reach)), calc(-50% + ${-forward} * var(--reach)))` }} />
        {!drives && <span class="hint">Arm the robot to drive</span>}
      </div>
      <div class="limits">
        <Most label="At most" unit="m/s" most={speed_limit} value={Math.min(most.speed_mps, speed_limit)} set={(speed_mps) => set_most({ ...most, speed_mps })} />
        <Most label="and" unit="rad/s" most={turn_limit} value={Math.min(most.turn_radps, turn_limit)} set={(turn_radps) => set_most({ ...most, turn_radps })} />
        <p>
          <small>Hold the pad, or the arrow keys while it has the focus. The robot rests as soon as you let go.</small>
        </p>
      </div>
    </div>
  );
}

import { useEffect, useRef, useState } from "preact/hooks";
import type { Robot } from "./robot";

/** What `select` finds in the robot; whoever uses it is drawn anew only when that is another value. */
export function use_robot<Value>(robot: Robot, select: (robot: Robot) => Value): Value {
  const [, redraw] = useState(0);
  const shown = useRef<Value>();
  shown.current = select(robot);
  useEffect(
    () =>
      robot.subscribe(() => {
        if (!Object.is(select(robot), shown.current)) redraw((n) => n + 1);
      }),
    [robot],
  );
  return shown.current as Value;
}

/** Calls both before each picture in which samples or poses are new (Frames::add). */
export function use_frames(robot: Robot, draw: () => void, write: () => void) {
  const newest = useRef({ draw, write });
  newest.current = { draw, write };
  useEffect(() => robot.frames.add(() => newest.current.draw(), () => newest.current.write()), [robot]);
}

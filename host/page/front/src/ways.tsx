import { useEffect, useRef } from "preact/hooks";
import { box_of, Plan } from "./plan";

/** One drive: where odometry says the robot is, and where it is; x and y in turn, m, from its start. */
export interface Way {
  phase: string;
  odometry: number[];
  truth: number[];
}

function draw(canvas: HTMLCanvasElement, ways: Way[]) {
  const plan = new Plan(canvas, box_of(ways.flatMap((way) => [way.odometry, way.truth]), 0.5));
  const style = getComputedStyle(canvas);
  const truth = style.getPropertyValue("--truth"),
    odometry = style.getPropertyValue("--odometry");
  ways.forEach((way, i) => {
    const newest = i === ways.length - 1;
    plan.line(way.truth, truth, 2, newest ? 1 : 0.18);
    plan.line(way.odometry, odometry, 2, newest ? 1 : 0.3);
  });
  const last = ways.at(-1);
  for (const [points, colour] of [[last?.truth, truth], [last?.odometry, odometry]] as const)
    if (points && points.length >= 2) plan.dot(points.at(-2)!, points.at(-1)!, colour);
}

/** The drives of one phase over each other, the newest in full colour. */
export function Ways(props: { ways: Way[]; label: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    const again = () => draw(element, props.ways);
    again();
    const observer = new ResizeObserver(again);
    observer.observe(element);
    return () => observer.disconnect();
  });
  return <canvas ref={canvas} class="ways" role="img" aria-label={props.label} />;
}

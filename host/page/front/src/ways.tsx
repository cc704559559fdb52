import { useEffect, useRef } from "preact/hooks";

/** One drive: where odometry says the robot is, and where it is; x and y in turn, m, from its start. */
export interface Way {
  phase: string;
  odometry: number[];
  truth: number[];
}

interface Box {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

function box_of(ways: Way[]): Box {
  const box = { left: -0.5, right: 0.5, bottom: -0.5, top: 0.5 };
  for (const way of ways)
    for (const points of [way.odometry, way.truth])
      for (let i = 0; i + 1 < points.length; i += 2) {
        box.left = Math.min(box.left, points[i]!);
        box.right = Math.max(box.right, points[i]!);
        box.bottom = Math.min(box.bottom, points[i + 1]!);
        box.top = Math.max(box.top, points[i + 1]!);
      }
  return box;
}

function draw(canvas: HTMLCanvasElement, ways: Way[]) {
  const scale = devicePixelRatio;
  canvas.width = canvas.clientWidth * scale;
  canvas.height = canvas.clientHeight * scale;
  const context = canvas.getContext("2d");
  if (!context) return;
  const style = getComputedStyle(canvas);
  const box = box_of(ways);
  const margin = 14 * scale;
  const zoom = Math.min(
    (canvas.width - 2 * margin) / (box.right - box.left),
    (canvas.height - 2 * margin) / (box.top - box.bottom),
  );
  const middle = [(box.left + box.right) / 2, (box.bottom + box.top) / 2] as const;
  const at = (x: number, y: number) =>
    [canvas.width / 2 + zoom * (x - middle[0]), canvas.height / 2 - zoom * (y - middle[1])] as const;
  const line = (points: number[], colour: string, width: number, alpha: number) => {
    context.strokeStyle = colour;
    context.lineWidth = width * scale;
    context.globalAlpha = alpha;
    context.beginPath();
    for (let i = 0; i + 1 < points.length; i += 2) context.lineTo(...at(points[i]!, points[i + 1]!));
    context.stroke();
  };
  const dot = (points: number[], colour: string) => {
    if (points.length < 2) return;
    context.fillStyle = colour;
    context.beginPath();
    context.arc(...at(points.at(-2)!, points.at(-1)!), 5 * scale, 0, 2 * Math.PI);
    context.fill();
  };
  const truth = style.getPropertyValue("--truth"),
    odometry = style.getPropertyValue("--odometry");
  ways.forEach((way, i) => {
    const newest = i === ways.length - 1;
    line(way.truth, truth, 2, newest ? 1 : 0.18);
    line(way.odometry, odometry, 2, newest ? 1 : 0.3);
  });
  context.globalAlpha = 1;
  const last = ways.at(-1);
  if (!last) return;
  dot(last.truth, truth);
  dot(last.odometry, odometry);
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

import { useEffect, useRef } from "preact/hooks";
import { box_of, Plan } from "./plan";

/** One drive: where odometry says the robot is, and where it is; x and y in turn, m, from its start. */
export interface Way {
  phase: string;
  odometry: number[];
  truth: number[];
}

/** The drives before the newest change with none of its points: they are drawn once, and copied from then on. */
class Picture {
  private readonly earlier = document.createElement("canvas");
  private drawn = "";

  draw(canvas: HTMLCanvasElement, ways: Way[]) {
    const box = box_of(ways.flatMap((way) => [way.odometry, way.truth]), 0.5);
    const plan = new Plan(canvas, box);
    if (canvas.width === 0 || canvas.height === 0) return; // of a page that is not shown
    const style = getComputedStyle(canvas);
    const truth = style.getPropertyValue("--truth"),
      odometry = style.getPropertyValue("--odometry");
    const newest = ways.at(-1);
    const drawn = [canvas.width, canvas.height, truth, odometry, ways.length, ...Object.values(box)].join();
    if (drawn === this.drawn) plan.context.drawImage(this.earlier, 0, 0);
    else {
      for (const way of ways.slice(0, -1)) {
        plan.line(way.truth, truth, 2, 0.18);
        plan.line(way.odometry, odometry, 2, 0.3);
      }
      [this.earlier.width, this.earlier.height] = [canvas.width, canvas.height];
      this.earlier.getContext("2d")!.drawImage(canvas, 0, 0);
      this.drawn = drawn;
    }
    for (const [points, colour] of [[newest?.truth, truth], [newest?.odometry, odometry]] as const) {
      if (!points || points.length < 2) continue;
      plan.line(points, colour, 2);
      plan.dot(points.at(-2)!, points.at(-1)!, colour);
    }
  }
}

/** The drives of one phase over each other, the newest in full colour. */
export function Ways({ ways, label }: { ways: Way[]; label: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const picture = useRef<Picture>();
  const draw = useRef(() => {});
  draw.current = () => (picture.current ??= new Picture()).draw(canvas.current!, ways);
  useEffect(() => draw.current(), [ways.length, ways.at(-1)?.truth.length]);
  useEffect(() => {
    const observer = new ResizeObserver(() => draw.current());
    observer.observe(canvas.current!);
    return () => observer.disconnect();
  }, []);
  return <canvas ref={canvas} class="ways" role="img" aria-label={label} />;
}

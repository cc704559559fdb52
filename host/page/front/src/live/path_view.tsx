import { useEffect, useRef } from "preact/hooks";
import { box_of, Plan } from "../plan";
import type { Pose } from "./contract";
import { nice_step, tick_text } from "./nice";
import type { Robot } from "./robot";
import { use_frames } from "./use_robot";

/** A robot is drawn as a disc of this radius with a line to its front. */
const kRadius_m = 0.15;
const kSquaresAcross = 6;
/** A robot drives some centimetres in this time, and its whole path is drawn anew. */
const kEvery_ms = 45;

function draw_grid(plan: Plan, colour: string, text: string) {
  const { canvas, context, scale, zoom } = plan;
  const step_m = nice_step(canvas.width / zoom / kSquaresAcross);
  const [x0, y0] = plan.at(0, 0);
  const first = (origin: number) => origin - Math.floor(origin / (zoom * step_m)) * zoom * step_m;
  const vertical = (x: number) => (context.moveTo(x, 0), context.lineTo(x, canvas.height));
  const horizontal = (y: number) => (context.moveTo(0, y), context.lineTo(canvas.width, y));
  context.strokeStyle = colour;
  context.lineWidth = scale;
  context.beginPath();
  for (let x = first(x0); x < canvas.width; x += zoom * step_m) vertical(Math.round(x) + 0.5);
  for (let y = first(y0); y < canvas.height; y += zoom * step_m) horizontal(Math.round(y) + 0.5);
  context.stroke();
  context.fillStyle = text;
  context.font = `${12 * scale}px system-ui, sans-serif`;
  context.fillText(`${tick_text(step_m, step_m)} m`, 8 * scale, canvas.height - 8 * scale);
  context.fillRect(8 * scale, canvas.height - 5 * scale, Math.min(zoom * step_m, canvas.width), 1.5 * scale);
}

function draw_robot(plan: Plan, { x_m, y_m, heading_rad }: Pose, colour: string, filled: boolean) {
  const { context, scale } = plan;
  const [x, y] = plan.at(x_m, y_m);
  // Small in a large hall, but never too small to be seen.
  const radius = Math.max(plan.zoom * kRadius_m, 7 * scale);
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 2 * scale;
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  if (filled) {
    context.globalAlpha = 0.18;
    context.fill();
    context.globalAlpha = 1;
  }
  context.moveTo(x, y);
  context.lineTo(x + 1.3 * radius * Math.cos(heading_rad), y - 1.3 * radius * Math.sin(heading_rad));
  context.stroke();
}

function draw(canvas: HTMLCanvasElement, robot: Robot) {
  if (canvas.clientWidth === 0) return;
  const style = getComputedStyle(canvas);
  const { odometry, truth } = robot;
  const plan = new Plan(canvas, box_of([odometry.points, truth.points], 0.5, 1.3 * kRadius_m));
  draw_grid(plan, style.getPropertyValue("--pico-muted-border-color"), style.getPropertyValue("--pico-muted-color"));
  plan.line(truth.points, style.getPropertyValue("--truth"), 2);
  plan.line(odometry.points, style.getPropertyValue("--odometry"), 2);
  if (truth.pose) draw_robot(plan, truth.pose, style.getPropertyValue("--truth"), false);
  if (odometry.pose) draw_robot(plan, odometry.pose, style.getPropertyValue("--odometry"), true);
}

/** From −180 to 180°. */
const degrees = (angle_rad: number) => ((Math.atan2(Math.sin(angle_rad), Math.cos(angle_rad)) * 180) / Math.PI).toFixed(1);
const pose_text = ({ x_m, y_m, heading_rad }: Pose) => `${x_m.toFixed(3)} m, ${y_m.toFixed(3)} m, ${degrees(heading_rad)}°`.replaceAll("-", "−");

/** Where the robot is, and where it has been: by odometry, and by whoever sees it. */
export function PathView({ robot }: { robot: Robot }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const odometry = useRef<HTMLDataElement>(null), apart = useRef<HTMLDataElement>(null);
  const drawn_ms = useRef(0);
  const redraw = () => {
    drawn_ms.current = performance.now();
    if (canvas.current) draw(canvas.current, robot);
  };
  const redraw_soon = () => {
    if (performance.now() - drawn_ms.current > kEvery_ms) redraw();
  };
  const show_poses = () => {
    const [by_wheels, seen] = [robot.odometry.pose, robot.truth.pose];
    odometry.current!.textContent = by_wheels ? pose_text(by_wheels) : "–";
    apart.current!.textContent = by_wheels && seen ? `${(1000 * Math.hypot(by_wheels.x_m - seen.x_m, by_wheels.y_m - seen.y_m)).toFixed(1)} mm apart` : "not seen by anybody";
  };
  use_frames(robot, redraw_soon, show_poses);
  useEffect(() => {
    const observer = new ResizeObserver(redraw);
    observer.observe(canvas.current!);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", redraw);
    return () => {
      observer.disconnect();
      dark.removeEventListener("change", redraw);
    };
  }, []);
  return (
    <section aria-label="Path" class="panel path">
      <div class="head">
        <h2>Path</h2>
        <span class="spring" />
        <button type="button" class="outline" onClick={() => { robot.odometry.clear(); robot.truth.clear(); robot.frames.request(); }}>
          Clear
        </button>
      </div>
      <canvas ref={canvas} class="ways" role="img" aria-label="The robot and its path from above" />
      <p class="legend">
        <span class="odometry">odometry</span> <data ref={odometry}>–</data>
        <span class="truth">where it really is</span> <data ref={apart}>–</data>
      </p>
    </section>
  );
}

import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { value_text } from "./nice";
import type { Robot } from "./robot";
import { kAxis, kTraceColours, ScopeView, trace_colour, type Trace } from "./scope_view";
import { type Condition, kBefore, Trigger } from "./trigger";
import { use_frames } from "./use_robot";
import { unit_text, words } from "./words";

const kValuesEvery_ms = 100;

/** Without a trigger, with one that is caught each time, or with one that is caught once. */
export type Mode = "roll" | "each" | "once";

interface Screen {
  robot: Robot;
  traces: Trace[];
  window_s: number;
  mode: Mode;
  condition: Condition;
  paused: boolean;
  /** By how much what is shown of a paused scope ends before it was paused. */
  earlier_s: number;
  /** A trigger that is wanted once has come. */
  caught: () => void;
}

function colours_of(element: HTMLElement) {
  const style = getComputedStyle(element);
  const colour = (name: string) => style.getPropertyValue(name);
  return {
    traces: Array.from({ length: kTraceColours }, (_, i) => colour(`--trace-${i}`)),
    text: colour("--pico-muted-color"),
    grid: colour("--pico-muted-border-color"),
  };
}

/** A view on these canvases, with their present size and the present colours. */
function use_view(robot: Robot, front: RefObject<HTMLCanvasElement>, back: RefObject<HTMLCanvasElement>) {
  const view = useRef<ScopeView>();
  useEffect(() => {
    view.current = new ScopeView(robot.samples, front.current!, back.current!);
    const adapt = () => {
      view.current!.colours = colours_of(front.current!);
      view.current!.redraw();
      robot.frames.request();
    };
    const observer = new ResizeObserver(adapt);
    observer.observe(front.current!);
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", adapt);
    return () => {
      observer.disconnect();
      dark.removeEventListener("change", adapt);
    };
  }, []);
  return view;
}

/** The traces, a cursor that is moved by a pointer or by arrow keys, and the values there; without a cursor the newest. */
export function ScopeScreen({ robot, traces, window_s, mode, condition, paused, earlier_s, caught }: Screen) {
  const front = useRef<HTMLCanvasElement>(null), back = useRef<HTMLCanvasElement>(null);
  const cursor = useRef<HTMLDivElement>(null), status = useRef<HTMLSpanElement>(null), values = useRef<HTMLUListElement>(null);
  const view = use_view(robot, front, back);
  const trigger = useRef(new Trigger());
  const end_s = useRef(0), cursor_x = useRef<number | null>(null), values_ms = useRef(0);
  const ring = robot.samples;

  /** The right end of what is to be shown now; null while a trigger is waited for. */
  const next_end_s = (): number | null => {
    if (paused) return end_s.current - earlier_s;
    if (mode === "roll") return (end_s.current = ring.end > 0 ? ring.time(ring.end - 1) : 0);
    const at_s = trigger.current.next(ring, condition, window_s);
    if (at_s === null) return null;
    end_s.current = at_s + (1 - kBefore) * window_s;
    view.current!.redraw();
    if (mode === "once") caught();
    return end_s.current;
  };
  const draw = () => {
    const end = view.current && next_end_s();
    if (typeof end === "number") view.current!.draw(end);
    const waits = view.current && end === null ? "waiting for the trigger" : "";
    if (status.current && status.current.textContent !== waits) status.current.textContent = waits;
  };

  const cursor_s = (x: number) => view.current!.end_s - window_s * (1 - (x - kAxis.left) / view.current!.inner_width);
  const show_cursor = (x: number) => {
    const part = (x - kAxis.left) / view.current!.inner_width;
    const time_s = cursor_s(x) - view.current!.end_s + view.current!.zero_before_end_s;
    const text = `${time_s.toFixed(window_s < 1 ? 4 : 3).replace("-", "−")} s`;
    const label = cursor.current!.firstElementChild!;
    cursor.current!.style.transform = `translateX(${x}px)`;
    label.textContent = text;
    label.classList.toggle("left", part > 0.5);
    front.current!.setAttribute("aria-valuenow", String(Math.round(100 * part)));
    front.current!.setAttribute("aria-valuetext", text);
  };
  const show_values = () => {
    if (!view.current || !values.current) return;
    const x = cursor_x.current;
    cursor.current!.hidden = x === null;
    if (x !== null) show_cursor(x);
    const sample = x === null ? ring.end - 1 : Math.min(ring.end - 1, ring.at_or_after(cursor_s(x)));
    traces.forEach(({ name }, i) => {
      values.current!.children[i]!.querySelector("data")!.textContent = value_text(sample < ring.begin ? NaN : ring.value(name, sample));
    });
  };
  use_frames(robot, draw, () => {
    const now = performance.now();
    if (now - values_ms.current < kValuesEvery_ms) return;
    values_ms.current = now;
    show_values();
  });

  const lanes = new Set(traces.map(({ unit }) => unit)).size;
  const shown = traces.map(({ name }) => name).join();
  useEffect(() => view.current!.show(traces), [shown]);
  useEffect(() => {
    view.current!.window_s = window_s;
    view.current!.zero_before_end_s = mode === "roll" ? 0 : (1 - kBefore) * window_s;
    view.current!.redraw();
    robot.frames.request();
  }, [window_s, mode, paused, earlier_s]);
  useEffect(() => trigger.current.restart(ring), [mode, condition, window_s, paused]);

  const point = (x: number | null) => {
    if (!view.current) return;
    cursor_x.current = x === null ? null : Math.min(kAxis.left + view.current.inner_width, Math.max(kAxis.left, x));
    show_values();
  };
  const key = (event: KeyboardEvent) => {
    const right = kAxis.left + view.current!.inner_width;
    const from = cursor_x.current ?? right;
    const step = view.current!.inner_width / (event.shiftKey ? 10 : 200);
    const to: Record<string, number | null> = { ArrowLeft: from - step, ArrowRight: from + step, Home: kAxis.left, End: right, Escape: null };
    if (!(event.key in to)) return;
    event.preventDefault();
    point(to[event.key]!);
  };
  return (
    <>
      <div class="screen" style={{ minHeight: `${5.5 * lanes}rem` }}>
        <canvas ref={back} aria-hidden="true" />
        <canvas ref={front} tabIndex={0} role="slider" aria-label="Cursor of the scope" aria-valuemin={0} aria-valuemax={100} aria-valuenow={100} aria-valuetext="none"
          onKeyDown={key} onPointerMove={(event) => point(event.offsetX)} onPointerDown={(event) => point(event.offsetX)}
          onPointerLeave={(event) => event.pointerType === "mouse" && point(null)} />
        <div ref={cursor} class="cursor" hidden>
          <span />
        </div>
        <span ref={status} role="status" class="waiting" />
      </div>
      <ul class="values" ref={values}>
        {traces.map((trace) => (
          <li key={trace.name}>
            <i style={{ background: `var(--trace-${trace_colour(trace, traces)})` }} />
            {words(trace.name)} <data>–</data> <small>{unit_text(trace.unit)}</small>
          </li>
        ))}
      </ul>
    </>
  );
}

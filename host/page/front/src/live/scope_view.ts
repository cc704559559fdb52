import { nice_range, nice_step, type Range, tick_text } from "./nice";
import type { SampleRing } from "./sample_ring";
import { unit_text } from "./words";

export interface Trace {
  name: string;
  unit: string;
}

interface Lane {
  unit: string;
  traces: Trace[];
  top: number;
  height: number;
  range: Range;
}

export interface Colours {
  traces: string[];
  text: string;
  grid: string;
}

/** How many colours page.css has for traces. */
export const kTraceColours = 10;

/** The number of a trace's colour among all that are shown: none is twice in a lane of up to as many traces. */
export const trace_colour = (trace: Trace, shown: Trace[]) =>
  shown.filter((each) => each.unit === trace.unit).findIndex((each) => each.name === trace.name) % kTraceColours;

/** CSS pixels beside the traces, for the numbers of the axes. */
export const kAxis = { left: 58, right: 8, bottom: 24, top: 6 };
const kBetweenLanes = 10;
const kShortestTick = 44;
const kLookForRoom_ms = 1000;
/** Samples that are farther apart are not joined. */
const kGap_s = 0.1;

/**
 * Draws the newest samples of up to 20 signals, a lane for each unit, with an axis of its own. As time passes the picture is moved to
 * the left and only what is new is drawn, because drawing a whole window of 20 signals at 1 kHz takes longer than a frame.
 */
export class ScopeView {
  window_s = 5;
  /** From the right end of the window to the moment that is called 0 s. */
  zero_before_end_s = 0;
  colours: Colours = { traces: Array(kTraceColours).fill("gray"), text: "gray", grid: "gray" };
  private lanes: Lane[] = [];
  private whole = true;
  private column = 0;
  private drawn_end = 0;
  private room_ms = 0;
  private size = { width: 0, height: 0 };
  /** Canvas pixels in a CSS pixel. */
  private scale = 1;

  constructor(
    private ring: SampleRing,
    private front: HTMLCanvasElement,
    private back: HTMLCanvasElement,
  ) {}

  show(traces: Trace[]) {
    const units = [...new Set(traces.map((each) => each.unit))];
    this.lanes = units.map((unit) => ({
      unit,
      traces: traces.filter((each) => each.unit === unit),
      top: 0,
      height: 0,
      range: { low: 0, high: 0, step: 0 },
    }));
    this.redraw();
  }

  /** Draws everything the next time: something else has changed than time. */
  redraw() {
    this.whole = true;
  }

  /** The window's right end that was drawn last, s. */
  get end_s() {
    return (this.column + 1) * this.column_s;
  }

  /** Of the traces' part of the canvas, CSS pixels. */
  get inner_width() {
    return Math.max(1, this.size.width - kAxis.left - kAxis.right);
  }

  /** What is shown ends at `end_s`. */
  draw(end_s: number) {
    if (!this.fit_canvases()) return;
    const column = Math.floor(end_s / this.column_s);
    const ahead = column - this.column;
    this.whole ||= ahead < 0 || ahead > this.columns / 2;
    this.make_room(end_s);
    if (!this.whole && ahead === 0 && this.ring.end === this.drawn_end) return;
    // The column that was newest until now may have been incomplete.
    const from = this.whole ? column - this.columns + 1 : this.column - 1;
    this.column = column;
    if (this.whole) this.draw_axes();
    else this.move(ahead);
    this.draw_traces(from);
    this.whole = false;
    this.drawn_end = this.ring.end;
  }

  /** Where the traces begin, canvas pixels. */
  private get left() {
    return Math.round(kAxis.left * this.scale);
  }
  private get columns() {
    return Math.round(this.inner_width * this.scale);
  }
  private get column_s() {
    return this.window_s / this.columns;
  }

  /** False while nobody can see it. */
  private fit_canvases(): boolean {
    this.size = { width: this.front.clientWidth, height: this.front.clientHeight };
    this.scale = Math.min(2, devicePixelRatio);
    const [width, height] = [Math.round(this.size.width * this.scale), Math.round(this.size.height * this.scale)];
    if (width !== 0 && (this.front.width !== width || this.front.height !== height)) {
      for (const canvas of [this.front, this.back]) [canvas.width, canvas.height] = [width, height];
      this.redraw();
    }
    return width !== 0;
  }

  /** Widens the range of each lane for what is new, and narrows it when the whole window has had room to spare. */
  private make_room(end_s: number) {
    const now = performance.now();
    const narrow = this.whole || now - this.room_ms > kLookForRoom_ms;
    if (narrow) this.room_ms = now;
    const first = this.ring.at_or_after(end_s - this.window_s);
    const last = this.ring.at_or_after(end_s);
    for (const lane of this.lanes) {
      const seen = this.extent(lane, narrow ? first : Math.max(first, this.drawn_end), last);
      if (!seen) continue;
      const { low, high } = lane.range;
      const fits = seen.low >= low && seen.high <= high;
      const least = narrow || !(high > low) ? seen : { low: Math.min(low, seen.low), high: Math.max(high, seen.high) };
      const wanted = nice_range(least.low, least.high, 4);
      if (fits && !(narrow && wanted.high - wanted.low < 0.6 * (high - low))) continue;
      lane.range = wanted;
      this.whole = true;
    }
  }

  private extent(lane: Lane, first: number, last: number): { low: number; high: number } | null {
    let [low, high] = [Infinity, -Infinity];
    for (const { name } of lane.traces) {
      const values = this.ring.column(name);
      if (!values) continue;
      for (let n = first; n < last; ++n) {
        const value = values[n % this.ring.capacity]!;
        if (value < low) low = value;
        if (value > high) high = value;
      }
    }
    return low <= high ? { low, high } : null;
  }

  private move(columns: number) {
    const context = this.front.getContext("2d")!;
    context.globalCompositeOperation = "copy";
    context.drawImage(this.front, -columns, 0);
    context.globalCompositeOperation = "source-over";
    // What leaves the lanes would be drawn over the numbers beside them.
    context.clearRect(0, 0, this.left, this.front.height);
  }

  /** Draws anew from this column on, counted as time is, to the newest. */
  private draw_traces(from: number) {
    const context = this.front.getContext("2d")!;
    const first = this.column - this.columns + 1;
    const x = this.left + Math.max(0, from - first);
    context.save();
    context.beginPath();
    context.rect(x, 0, this.left + this.columns - x, this.front.height);
    context.clip();
    context.clearRect(0, 0, this.front.width, this.front.height);
    context.lineWidth = 1.2 * this.scale;
    context.lineJoin = "bevel";
    const begin = Math.max(this.ring.begin, this.ring.at_or_after(from * this.column_s) - 1);
    const end = Math.min(this.ring.end, this.ring.at_or_after(this.end_s) + 1);
    for (const lane of this.lanes)
      for (const trace of lane.traces) {
        context.strokeStyle = context.fillStyle = this.colours.traces[trace_colour(trace, lane.traces)]!;
        this.line(context, lane, trace, begin, end, this.left - first);
      }
    context.restore();
  }

  /** With several samples in a column, it is filled from the least to the greatest: a line through all of them takes ten times as long. */
  private line(context: CanvasRenderingContext2D, lane: Lane, trace: Trace, begin: number, end: number, x0: number) {
    const values = this.ring.column(trace.name);
    const { low, high } = lane.range;
    if (!values || end <= begin || !(high > low)) return;
    const zoom = (this.scale * lane.height) / (high - low);
    const bottom = this.scale * (lane.top + lane.height) + zoom * low;
    const y_of = (sample: number) => bottom - zoom * values[sample % this.ring.capacity]!;
    const per_column = ((end - begin) * this.column_s) / (this.ring.time(end - 1) - this.ring.time(begin));
    if (per_column > 1.5) this.fill_columns(context, y_of, begin, end, x0);
    else this.stroke_samples(context, y_of, begin, end, x0);
  }

  private stroke_samples(context: CanvasRenderingContext2D, y_of: (sample: number) => number, begin: number, end: number, x0: number) {
    const { column_s } = this;
    const gap_s = Math.max(kGap_s, 4 * column_s);
    let previous_s = -Infinity;
    context.beginPath();
    for (let n = begin; n < end; ++n) {
      const t = this.ring.time(n);
      const y = y_of(n);
      if (Number.isNaN(y)) continue;
      const x = x0 + t / column_s;
      if (t - previous_s > gap_s) context.moveTo(x, y);
      else context.lineTo(x, y);
      previous_s = t;
    }
    context.stroke();
  }

  private fill_columns(context: CanvasRenderingContext2D, y_of: (sample: number) => number, begin: number, end: number, x0: number) {
    const { column_s } = this;
    const thick = context.lineWidth;
    let [column, least, most, last] = [-Infinity, 0, 0, NaN];
    const fill = () => {
      if (most >= least) context.fillRect(x0 + column, least - thick / 2, 1, most - least + thick);
    };
    for (let n = begin; n < end; ++n) {
      const y = y_of(n);
      if (Number.isNaN(y)) continue;
      const at = Math.floor(this.ring.time(n) / column_s);
      if (at !== column) {
        if (column !== -Infinity) fill();
        // Neighbouring columns touch, unless nothing came for some time.
        const follows = at - column <= 2;
        column = at;
        least = follows ? Math.min(y, last) : y;
        most = follows ? Math.max(y, last) : y;
      } else if (y < least) least = y;
      else if (y > most) most = y;
      last = y;
    }
    if (column !== -Infinity) fill();
  }

  private draw_axes() {
    const context = this.back.getContext("2d")!;
    context.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    const { width, height } = this.size;
    context.clearRect(0, 0, width, height);
    context.font = "12px system-ui, sans-serif";
    context.lineWidth = 1;
    this.place_lanes(height);
    this.draw_times(context, height);
    for (const lane of this.lanes) this.draw_lane(context, lane);
  }

  private place_lanes(height: number) {
    const count = Math.max(1, this.lanes.length);
    const each = (height - kAxis.top - kAxis.bottom - kBetweenLanes * (count - 1)) / count;
    this.lanes.forEach((lane, i) => [lane.top, lane.height] = [kAxis.top + i * (each + kBetweenLanes), each]);
  }

  private draw_lane(context: CanvasRenderingContext2D, lane: Lane) {
    const [left, width] = [kAxis.left, this.inner_width];
    const { low, high, step } = lane.range;
    if (step === 0) return;
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.strokeStyle = this.colours.grid;
    context.fillStyle = this.colours.text;
    const every = Math.max(1, Math.ceil(20 / ((lane.height * step) / (high - low))));
    for (let i = 0; low + i * step <= high + step / 2; i += every) {
      const y = Math.round(lane.top + lane.height - (lane.height * i * step) / (high - low)) + 0.5;
      context.beginPath();
      context.moveTo(left, y);
      context.lineTo(left + width, y);
      context.stroke();
      context.fillText(tick_text(low + i * step, step), left - 6, Math.min(Math.max(y, lane.top + 6), lane.top + lane.height - 6));
    }
    context.save();
    context.translate(10, lane.top + lane.height / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.fillText(unit_text(lane.unit), 0, 0);
    context.restore();
  }

  private draw_times(context: CanvasRenderingContext2D, height: number) {
    const [left, width] = [kAxis.left, this.inner_width];
    const step = nice_step((this.window_s * kShortestTick * 1.6) / width);
    context.textAlign = "center";
    context.textBaseline = "alphabetic";
    context.strokeStyle = this.colours.grid;
    context.fillStyle = this.colours.text;
    const zero = this.window_s - this.zero_before_end_s;
    for (let i = Math.ceil(-zero / step); i * step <= this.zero_before_end_s + 1e-9; ++i) {
      const x = Math.round(left + (width * (zero + i * step)) / this.window_s) + 0.5;
      context.beginPath();
      context.moveTo(x, kAxis.top);
      context.lineTo(x, height - kAxis.bottom);
      context.stroke();
      if (x < left + 10 || x > left + width - 10) continue;
      context.fillText(`${tick_text(i * step, step)} s`, x, height - 7);
    }
  }
}

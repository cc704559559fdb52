export interface Range {
  low: number;
  high: number;
  step: number;
}

/** 1, 2 or 5 times a power of ten, at least as large. */
export function nice_step(wanted: number): number {
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * ([1, 2, 5, 10].find((each) => each * power >= wanted * (1 - 1e-9)) ?? 10);
}

/** The least range of whole steps, about `steps` of them, in which all values lie. */
export function nice_range(low: number, high: number, steps: number): Range {
  // A value that does not change is shown in the middle.
  const half = Math.max((high - low) / 2, 1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-6) * 1.05;
  const middle = (low + high) / 2;
  const step = nice_step((2 * half) / steps);
  return { low: Math.floor((middle - half) / step) * step, high: Math.ceil((middle + half) / step) * step, step };
}

/** A tick's number with the digits that its step has. */
export function tick_text(value: number, step: number): string {
  const text = value.toFixed(Math.min(6, Math.max(0, -Math.floor(Math.log10(step) + 1e-9))));
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

/** A value with four digits that count. */
export function value_text(value: number | null | undefined): string {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  const digits = value === 0 ? 3 : Math.min(4, Math.max(0, 3 - Math.floor(Math.log10(Math.abs(value)))));
  return value.toFixed(digits).replace("-", "−");
}

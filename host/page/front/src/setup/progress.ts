import { useRef, useState } from "preact/hooks";
import type { Values } from "./put_in_force";

export const kSteps = [
  { name: "robot", title: "The robot" },
  { name: "wires", title: "Wires" },
  { name: "counts", title: "Counts per turn" },
  { name: "sizes", title: "Wheels and wheelbase" },
  { name: "tune", title: "Speed control" },
  { name: "metre", title: "First metre" },
  { name: "truth", title: "Ground truth" },
  { name: "calibrate", title: "Calibration" },
  { name: "sheet", title: "This robot" },
] as const;
export type StepName = (typeof kSteps)[number]["name"];

/** What a step has found, a line each; none if it was skipped. */
export interface Done {
  skipped: boolean;
  lines: string[];
}

/** How far the robot is set up. It is kept in this browser, so that a step that was interrupted can be done again later. */
export interface Progress {
  /** How the robot is opened. */
  question: { port?: string; simulated?: SimulatedRobot };
  /** The robot that answered then (Opened.unique_id): another one may be at the same port now. */
  robot?: string;
  at: StepName;
  done: Partial<Record<StepName, Done>>;
  /** Put in force on the way. A robot that this page simulates forgets them with the page. */
  loaded: Values;
  /** What was mended in the wires, which are looked at once more then. */
  mended: string[];
  /** Which ground truth was chosen (truths.ts). */
  truth: string;
}

export interface SimulatedRobot {
  wiring?: string[];
  [member: string]: unknown;
}

const kPlace = "astrolabe-setup";

function kept(): Progress | null {
  try {
    return JSON.parse(localStorage.getItem(kPlace) ?? "null") as Progress | null;
  } catch {
    return null; // not ours, or a browser that keeps nothing
  }
}

function keep(progress: Progress | null) {
  try {
    if (progress) localStorage.setItem(kPlace, JSON.stringify(progress));
    else localStorage.removeItem(kPlace);
  } catch {
    // It is then kept until the page goes.
  }
}

export type Change = (change: (before: Progress) => Progress) => void;

/** The progress, whoever asks and whenever: steps wait for the robot while others change it. */
export interface Held {
  readonly now: Progress | null;
  begin: (progress: Progress | null) => void;
  change: Change;
}

export function use_progress(): Held {
  const held = useRef<Progress | null>();
  const [, redraw] = useState(0);
  if (held.current === undefined) held.current = kept();
  const begin = (progress: Progress | null) => {
    held.current = progress;
    keep(progress);
    redraw((n) => n + 1);
  };
  return {
    get now() {
      return held.current!;
    },
    begin,
    change: (of) => held.current && begin(of(held.current)),
  };
}

/** The step after this one. */
export const next_step = (at: StepName): StepName => kSteps[Math.min(kSteps.findIndex((each) => each.name === at) + 1, kSteps.length - 1)]!.name;

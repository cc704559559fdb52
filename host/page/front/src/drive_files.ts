/** What the calls `inspect` and `calibrate` answer (host/page/calls/inspect.hpp, calibrate.hpp). */
import type { Factors } from "./factors";

export interface Problem {
  sentence: string;
  remedies: string[];
}

export interface Table {
  names: string[];
  columns: number;
  rows: string[][];
}

export interface Body {
  name: string;
  id: string;
  format: string;
  length_unit: string;
  start_time: string;
  samples: number;
  duration_s: number;
  median_period_s: number;
  lost: number;
  gaps: number;
  longest_gap_s: number;
  up_by_positions: number[] | null;
  remarks: string[];
}

export interface WheelsFound {
  unit: string;
  columns: { time: string; left: string[]; right: string[]; values: string };
  /** Whose times: the table's, the messages' stamps, or those of the recorder. */
  clock: "file" | "stamp" | "receipt";
  /** Of a bag, "" otherwise; and the topic from whose poses the wheels were worked out. */
  joints: { left: string; right: string };
  odometry: string;
  samples: number;
  duration_s: number;
  rate_hz: number;
  longest_gap_s: number;
  remarks: string[];
}

export interface BagFound {
  poses: { topic: string; frame: string; child_frame: string; poses: number }[];
  joints: string[];
  wheels: { left: string; right: string } | null;
  wheel_sources: { name: string; unit: string | null; taken: boolean }[];
  topics: { name: string; type: string; messages: number; rate_hz: number; longest_gap_s: number }[];
  warnings: string[];
}

type Inspection =
  | ({ kind: "bag" } & BagFound)
  | { kind: "tracker"; bodies: Body[] }
  | ({ kind: "wheels" } & WheelsFound)
  | { kind: "wheels and poses"; wheels: WheelsFound; tracker: { bodies: Body[] } }
  | { kind: "robot"; wheel_diameter_m: number | null; counts_per_turn: number | null; wheelbase_m: number | null }
  | { kind: "end poses"; runs: number };

export interface Inspected {
  name: string;
  wheels: boolean;
  truth: boolean;
  robot: boolean;
  scans: boolean;
  controllers: string[];
  inspection: Inspection | null;
  understood: { wheels?: WheelsFound; truth?: Body };
  problem: Problem | null;
  table: Table | null;
  preview: {
    wheels?: { t_s: number[]; left: number[]; right: number[]; unit: string };
    truth?: { t_s: number[]; x_m: (number | null)[]; y_m: (number | null)[]; z_m: (number | null)[] };
  };
}

export interface Drive {
  wheels: string;
  truth: string;
}

export interface Found {
  files: Inspected[];
  drives: Drive[];
  roles: { wheels: string[]; truth: string[] };
  units: { wheels: string[]; truth: string[] };
}

export interface Calibrated {
  calibration: Factors & { carried?: Factors; loaded?: Factors; standard_errors: Factors; standard_errors_another_day?: Factors };
  drives: { name: string; summary: string; remarks: string[] }[];
  verdict: string;
  advises_against: boolean;
  remarks: string[];
  toml: string;
  report: string | null;
  ros2: string | null;
  not_in_ros2: string | null;
}

/** All bodies in the recording of a tracker, of which a robot is one. */
export const bodies_of = (file: Inspected): Body[] =>
  file.inspection?.kind === "tracker" ? file.inspection.bodies : file.inspection?.kind === "wheels and poses" ? file.inspection.tracker.bodies : [];

export const bag_of = (file: Inspected): BagFound | null => (file.inspection?.kind === "bag" ? file.inspection : null);

/** A log whose odometry and scans are in one file. */
export const is_log = (file: Inspected) => file.scans && !bag_of(file);

/** "y", or "" if positions do not show which axis points up; they never show whether it points up or down. */
export const axis_of = (up: number[] | null) => "xyz"[up?.findIndex((part) => Math.abs(part) > 0.99) ?? -1] ?? "";

export const unique = (all: string[]) => [...new Set(all.filter((each) => each !== ""))];

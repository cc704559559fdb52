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
  topics: { name: string; messages: number; rate_hz: number; longest_gap_s: number }[];
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
  inspection: Inspection | null;
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
  calibration: Factors & { carried: Factors; standard_errors: Factors; standard_errors_another_day: Factors };
  drives: { name: string; summary: string; remarks: string[] }[];
  verdict: string;
  advises_against: boolean;
  toml: string;
  report: string;
  ros2: string | null;
  not_in_ros2: string | null;
}

export const wheels_of = (file: Inspected): WheelsFound | null =>
  file.inspection?.kind === "wheels" ? file.inspection : file.inspection?.kind === "wheels and poses" ? file.inspection.wheels : null;

export const bodies_of = (file: Inspected): Body[] =>
  file.inspection?.kind === "tracker" ? file.inspection.bodies : file.inspection?.kind === "wheels and poses" ? file.inspection.tracker.bodies : [];

export const bag_of = (file: Inspected): BagFound | null => (file.inspection?.kind === "bag" ? file.inspection : null);

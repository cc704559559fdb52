/** What the calls and events of an open robot hold (host/page/robot/README.md). SI units. */
import type { Event_ } from "../backend";

export interface Parameter {
  name: string;
  value: number | string;
  unit: string;
  min: number;
  max: number;
  /** A text has none. */
  default?: number | string | null;
  doc: string;
  /** What a commit would put in force; null if that is the value. */
  staged: number | string | null;
}

export interface Signal {
  name: string;
  unit: string;
  group: string;
}

export interface Opened {
  port: string;
  /** Of the robot's processor, in hexadecimal digits. */
  unique_id: string;
  /** The number of this page, by which RobotState.driver names it. */
  page: number;
  simulated: boolean;
  name: string;
  firmware: string;
  hardware: string;
  parameters: Parameter[];
  signals: Signal[];
}

/** Signals of one moment each; a value that a moment lacks is null. */
export interface Samples extends Event_ {
  event: "samples";
  t_s: number[];
  signals: Record<string, (number | null)[]>;
}

export interface RobotState extends Event_ {
  event: "state";
  /** False when it was closed, perhaps by another page. */
  open: boolean;
  /** This and `moving` are null while the link is lost. */
  mode: string | null;
  armed: boolean;
  moving: boolean | null;
  /** The page that has armed the robot, 0 for none. */
  driver: number;
  faults: { name: string; remedy: string }[];
  battery_V: number | null;
  link: "up" | "lost";
  /** Of a link that is lost, a sentence. */
  why?: string | null;
  /** A sentence about another program that drives. */
  other_driver: string | null;
  /** The file that is being recorded. */
  recording: string | null;
  /** Recordings that have ended, and that nobody has removed. */
  recordings: string[];
}

export interface PathEvent extends Event_ {
  event: "path";
  done: number;
  /** "finished", or a sentence that says why it ended early. */
  ended: string | null;
}

/** In the frame of odometry, from where the robot was when it was opened. */
export interface Pose {
  x_m: number;
  y_m: number;
  heading_rad: number;
}

export interface Poses extends Event_, Pose {
  event: "pose";
  truth: Pose | null;
}

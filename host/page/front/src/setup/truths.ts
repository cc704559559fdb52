/** What can tell where the robot really was, and the command line that calibrates with it. PORT is the robot's. */
export interface Truth {
  name: string;
  what: string;
  minutes: string;
  error: string;
  command: string;
}

/** The simulator sees where its robot is; this page calibrates with that by itself. */
export const kSimulator = "simulator";

export const kTruths: Truth[] = [
  { name: "tracker", what: "a tracker (VRPN, NatNet, ROS 2)", minutes: "30", error: "0.02 % / 0.04 %", command: "astrolabe umbmark --port PORT --truth vrpn://HOST/BODY --out first" },
  { name: "film", what: "a phone that films it", minutes: "40", error: "0.02 % / 0.04 %", command: "astrolabe umbmark --port PORT --truth film --out first" },
  { name: "tape", what: "a tape measure", minutes: "80", error: "0.02 % / 0.15 %", command: "astrolabe umbmark --port PORT --truth manual --out first" },
  { name: "wall", what: "a wall and a ruler", minutes: "10", error: "0.02 % / 0.1 %", command: "astrolabe umbmark --port PORT --truth wall --out first" },
  { name: "scanner", what: "a laser scanner on the robot", minutes: "30", error: "by the rooms", command: "astrolabe umbmark --port PORT --truth lidar:SCANNER --out first" },
];

// The program that serves the page, and a simulated robot at a port.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, rmSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { createInterface } from "node:readline";
import { astrolabe, page } from "../module/places.mjs";

/** Where programs look for simulated robots: those of other tests are not found. */
const runtime = mkdtempSync(path.join(os.tmpdir(), "page-runtime-"));
process.on("exit", () => rmSync(runtime, { recursive: true }));

/** Waits for the first line that the program `says` on "stdout" or "stderr". */
async function started(says, ...words) {
  const program = spawn(astrolabe, words, { stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, XDG_RUNTIME_DIR: runtime } });
  let said = "";
  program.stderr.on("data", (text) => (said += text));
  const lines = createInterface({ input: program[says] });
  const first = await Promise.race([once(lines, "line"), once(program, "exit").then(() => [""])]);
  if (program.exitCode !== null) throw new Error(`${words.join(" ")}: ${said}`);
  return { first: first[0], program };
}

export async function ended(program, signal = "SIGTERM") {
  if (program.exitCode !== null || program.signalCode !== null) return;
  program.kill(signal);
  await once(program, "exit");
}

/** A robot behind a pty, which is at the same path each time it is started. */
export class PortOfRobot {
  constructor(folder) {
    this.path = path.join(folder, "robot");
  }
  async start() {
    this.program = (await started("stderr", "sim", "--pty", this.path)).program;
  }
  /** As if its cable were pulled. */
  lose() {
    return ended(this.program, "SIGKILL");
  }
}

/** `use` on a robot at a port. */
export async function with_robot(use) {
  const folder = mkdtempSync(path.join(os.tmpdir(), "page-robot-"));
  const robot = new PortOfRobot(folder);
  try {
    await robot.start();
    await use(robot);
  } finally {
    if (robot.program) await ended(robot.program);
    rmSync(folder, { recursive: true });
  }
}

/** `use` on the program that serves the page, and on the link that it prints. */
export async function with_dashboard(words, use) {
  const { first, program } = await started("stdout", "dashboard", "--listen", "0", "--no-browser", "--page", page, ...words);
  try {
    await use(first, program);
  } finally {
    await ended(program);
  }
}

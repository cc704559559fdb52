import type { Robot } from "../live/robot";

export type Values = Record<string, number>;

/** Puts parameters in force together. Refuses with the remedy "confirm" what a person has to confirm, unless it is confirmed. */
export async function put_in_force(robot: Robot, values: Values, confirm: boolean) {
  await robot.backend.ask("robot/discard", {});
  try {
    for (const [name, value] of Object.entries(values)) await robot.backend.ask("robot/stage", { name, value });
    await robot.backend.ask("robot/commit", { confirm });
  } finally {
    await robot.backend.ask("robot/discard", {}).catch(() => {}); // the robot may be gone, which the page says elsewhere
  }
  await robot.read_parameters();
}

export const parameter = (robot: Robot, name: string) => Number(robot.parameters.find((each) => each.name === name)?.value ?? NaN);

/** "counts_per_motor_rev 64 → 32, ..." */
export const changes_text = (robot: Robot, values: Values) =>
  Object.entries(values).map(([name, value]) => `${name} ${parameter(robot, name)} → ${Number(value.toPrecision(7))}`).join(", ");

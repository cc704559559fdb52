// What people do on the page Set up.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { button, panel } from "./live.mjs";

/** What the picture shows of each wheel: "forward", "backward" or null. */
const seen = (page) =>
  page.locator(".wheel-of-picture").evaluateAll((wheels) => {
    const way = ({ classList }) => (classList.contains("ahead") ? "forward" : classList.contains("back") ? "backward" : null);
    return { left: way(wheels[0]), right: way(wheels[1]) };
  });

export const drive_button = (page, motor) => button(page, `The wheels hang free: drive the ${motor} motor`);

/** Drives one motor and says what the picture shows, which is one wheel. */
export async function look_at(page, motor) {
  await drive_button(page, motor).click();
  await page.getByText(`The ${motor} motor was driven forward.`).waitFor();
  const turned = Object.entries(await seen(page)).filter(([, way]) => way !== null);
  assert.equal(turned.length, 1, JSON.stringify(turned));
  const [[wheel, way]] = turned;
  await button(page, `${wheel} wheel, ${way}`).click();
  return { wheel, way };
}

export async function look_at_both(page) {
  await look_at(page, "left");
  await look_at(page, "right");
}

/** Presses it in this step, and waits for what comes then. */
export async function press(page, step, name, next) {
  await panel(page, step).getByRole("button", { name, exact: true }).click();
  await next.waitFor({ timeout: 120_000 });
}

/** The button of a step, by which it is known that the step has come so far. */
export const in_step = (page, step, name) => panel(page, step).getByRole("button", { name, exact: true });

export const told = (page, step, text) => panel(page, step).getByText(text);

/** Everything that is wrong with the robot is found and mended. `interrupt` is called in the middle of each step, which then begins again. */
export async function set_up(page, interrupt) {
  await button(page, "Simulate this robot").click();
  await panel(page, "Wires").waitFor({ timeout: 60_000 });
  await interrupt();
  assert.deepEqual(await look_at(page, "left"), { wheel: "right", way: "forward" });
  await interrupt();
  await look_at_both(page);
  await told(page, "Wires", "the motors are swapped").waitFor();
  await told(page, "Wires", "the right encoder counts the wrong way").waitFor();
  await press(page, "Wires", "Mend it: change the wires, load the rest", told(page, "Wires", "Check once more"));
  await interrupt();
  await look_at_both(page);
  await told(page, "Wires", "wired as the parameters say").waitFor();
  await press(page, "Wires", "Go on", panel(page, "Counts per turn"));

  await press(page, "Counts per turn", "Roll it by hand for 10 turns", in_step(page, "Counts per turn", "Compare with what it counted"));
  await interrupt();
  await press(page, "Counts per turn", "Roll it by hand for 10 turns", in_step(page, "Counts per turn", "Compare with what it counted"));
  await press(page, "Counts per turn", "Compare with what it counted", told(page, "Counts per turn", "counts_per_motor_rev is 32, not 64"));
  await press(page, "Counts per turn", "Mend it: load them", panel(page, "Wheels and wheelbase"));
  await interrupt();
  await press(page, "Wheels and wheelbase", "They are right: load them", panel(page, "Speed control"));

  await press(page, "Speed control", "The floor is free: measure", in_step(page, "Speed control", "Load them and drive the step again"));
  await interrupt();
  await press(page, "Speed control", "The floor is free: measure", in_step(page, "Speed control", "Load them and drive the step again"));
  await press(page, "Speed control", "Load them and drive the step again", in_step(page, "Speed control", "Go on"));
  await press(page, "Speed control", "Go on", panel(page, "First metre"));

  await press(page, "First metre", "The floor is free: drive one metre", in_step(page, "First metre", "Compare"));
  await interrupt();
  await press(page, "First metre", "The floor is free: drive one metre", in_step(page, "First metre", "Compare"));
  await press(page, "First metre", "Compare", told(page, "First metre", "counts per revolution are right"));
  await press(page, "First metre", "Go on", panel(page, "Ground truth"));
  await interrupt();
  await press(page, "Ground truth", "Go on with this", panel(page, "Calibration"));
  await interrupt();
  await press(page, "Calibration", "Drive and calibrate", in_step(page, "Calibration", "Go on"));
  await press(page, "Calibration", "Go on", panel(page, "This robot"));
  await interrupt();
}

/** What was loaded on the way, as the saved page shows it. */
async function saved(page, name) {
  const [download] = await Promise.all([page.waitForEvent("download"), button(page, name).click()]);
  return readFileSync(await download.path(), "utf8");
}

export async function expect_mended(page) {
  const sheet = await saved(page, "Save this robot's page");
  for (const line of ["mended: the motors are swapped", "mended: the right encoder counts the wrong way", "counts_per_motor_rev is 32, not 64"])
    assert.ok(sheet.includes(line), `${line} is not on the page`);
  const toml = await saved(page, "Save its parameters as TOML");
  for (const [name, value] of Object.entries({ encoder_polarity_right: -1, encoder_polarity_left: 1, motor_polarity_left: 1, motor_polarity_right: 1, counts_per_motor_rev: 32 }))
    assert.match(toml, new RegExp(`^${name} = ${value}(\\.0)?$`, "m"));
  // The simulated robot's right wheel is larger by 0.42 %; six squares show that to some hundredths of a percent.
  const factor = (name) => Number(toml.match(new RegExp(`^${name} = ([0-9.]+)`, "m"))[1]);
  assert.ok(Math.abs(factor("c_R") / factor("c_L") - 1.00416) < 5e-4, `c_R / c_L is ${factor("c_R") / factor("c_L")}`);
}

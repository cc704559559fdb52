// What people do on the page Live.
import assert from "node:assert/strict";

/** The line that shows the open robot on every page. */
export const strip = (page) => page.getByRole("region", { name: "Robot", exact: true });
export const panel = (page, name) => page.getByRole("region", { name, exact: true });
export const pad = (page) => page.getByRole("application", { name: /Drive pad/ });
export const button = (page, name) => page.getByRole("button", { name, exact: true });

/** Until the robot is in this mode, as people read it. */
export async function in_mode(page, mode) {
  await strip(page).getByText(mode, { exact: true }).waitFor({ timeout: 30_000 });
}

export async function simulate(page) {
  await button(page, "Simulate a robot").click();
  await in_mode(page, "disarmed");
}

export async function arm(page) {
  await button(page, "Arm").click();
  await in_mode(page, "armed");
}

/** x of the robot's odometry, m. */
export async function forward_m(page) {
  const text = await panel(page, "Path").locator("data").first().innerText();
  return Number(text.split(" m")[0].replace("−", "-"));
}

/** Until odometry says that the robot has come farther than this. */
export async function beyond(page, x_m) {
  await page.waitForFunction(
    (least) => Number(document.querySelector("[aria-label=Path] data").textContent.split(" m")[0].replace("−", "-")) > least,
    x_m,
    { timeout: 30_000 },
  );
}

/** Speeds that both wheels are told, m/s. */
export const wanted_mps = (page) =>
  page.locator("[aria-label=Wheels] .speed small data").evaluateAll((all) => all.map((each) => Number(each.textContent.replace("−", "-"))));

/** Until neither wheel is told to turn. */
export async function at_rest(page) {
  await page.waitForFunction(
    () => [...document.querySelectorAll("[aria-label=Wheels] .speed small data")].every((each) => Number(each.textContent) === 0),
    null,
    { timeout: 30_000 },
  );
}

/** What the page is being told that it cannot do. */
export async function no_complaint(page) {
  assert.deepEqual(await page.getByRole("alert").filter({ visible: true }).allInnerTexts(), []);
}

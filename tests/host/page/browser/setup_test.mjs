// The page Set up on a robot as somebody has just built it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { in_browser } from "./browser.mjs";
import { button, panel } from "./live.mjs";
import { expect_mended, in_step, press, set_up } from "./setup.mjs";

test("swapped motors, a reversed encoder and wrong counts are found and mended, and every step goes on after the page was reloaded", async () => {
  await in_browser("#setup", {}, async (page) => {
    await set_up(page, async () => {
      await page.reload();
      await button(page, "Go on there").click();
      await page.getByRole("navigation", { name: "Steps" }).waitFor({ timeout: 60_000 });
    });
    await expect_mended(page);
  });
});

test("each step can be skipped, and turned to again", async () => {
  await in_browser("#setup", {}, async (page) => {
    await button(page, "Simulate this robot").click();
    for (const step of ["Wires", "Counts per turn", "Wheels and wheelbase", "Speed control", "First metre", "Ground truth", "Calibration"])
      await press(page, step, "Skip this step", page.getByRole("navigation", { name: "Steps" }));
    await panel(page, "This robot").waitFor();
    assert.equal(await panel(page, "This robot").getByText("skipped").count(), 7);
    await page.getByRole("button", { name: /^Wires/ }).click();
    await panel(page, "Wires").waitFor();
  });
});

test("a wheel diameter that is far off is asked about before it is loaded", async () => {
  await in_browser("#setup", {}, async (page) => {
    await button(page, "Simulate this robot").click();
    await page.getByRole("button", { name: /^Wheels and wheelbase/ }).click();
    await panel(page, "Wheels and wheelbase").getByLabel("Wheel diameter").fill("720");
    await in_step(page, "Wheels and wheelbase", "They are right: load them").click();
    await page.getByRole("dialog").getByRole("button", { name: "Leave it" }).click();
    await panel(page, "Wheels and wheelbase").waitFor();
    await panel(page, "Wheels and wheelbase").getByLabel("Wheel diameter").fill("72");
    await press(page, "Wheels and wheelbase", "They are right: load them", panel(page, "Speed control"));
  });
});

test("turning to another page stops the robot on its metre, and the step says why", async () => {
  await in_browser("#setup", {}, async (page) => {
    await page.getByRole("checkbox").first().waitFor();
    for (const each of await page.getByRole("checkbox").all()) await each.uncheck();
    await button(page, "Simulate this robot").click();
    await page.getByRole("button", { name: /^First metre/ }).click();
    await in_step(page, "First metre", "The floor is free: drive one metre").click();
    await page.getByRole("region", { name: "Robot", exact: true }).getByText("on a path").waitFor();
    await page.getByRole("link", { name: "Try" }).click();
    await page.getByRole("link", { name: "Set up" }).click();
    await panel(page, "First metre").getByRole("alert").getByText("was stopped").waitFor();
  });
});

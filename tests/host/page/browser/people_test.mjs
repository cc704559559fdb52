// The pages for people with a small screen, at night, without a mouse, or with a screen reader.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { library } from "../module/places.mjs";
import { in_browser } from "./browser.mjs";
import { drive_files, sizes } from "./drive_files.mjs";
import { arm, button, in_mode, panel, simulate } from "./live.mjs";
import { look_at_both, press } from "./setup.mjs";

const axe = readFileSync(library.resolve("axe-core/axe.min.js"), "utf8");

/** What axe-core finds, a line each; the report in its frame is a page of its own. */
async function findings(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run({ exclude: [["iframe"]] }, { iframes: false }));
  return violations.map((each) => `${each.impact} ${each.id}: ${each.nodes.map((node) => node.target).join("; ")}`);
}

const pages = {
  "Try, before a drive": ["#try", async () => {}],
  "Try, with a result": [
    "#try",
    async (page) => {
      await page.getByRole("button", { name: "Drive and calibrate" }).click();
      await page.getByRole("region", { name: "Result" }).waitFor({ timeout: 120_000 });
    },
  ],
  "Your data, empty": ["#data", async () => {}],
  "Your data, with files and a refusal": [
    "#data",
    async (page) => {
      await page.getByLabel("Drop files").setInputFiles(drive_files());
      await page.getByRole("heading", { name: "Drives" }).waitFor({ timeout: 60_000 });
      for (const closed of await page.locator("details:visible > summary").all()) await closed.click();
      await page.getByRole("button", { name: "Calibrate", exact: true }).click();
      await page.getByRole("alert").waitFor({ timeout: 60_000 });
    },
  ],
  "Set up, before a robot": ["#setup", async (page) => page.getByText("How else it is built").click()],
  "Set up, with wires to be mended": [
    "#setup",
    async (page) => {
      await button(page, "Simulate this robot").click();
      await look_at_both(page);
      await panel(page, "Wires").getByText("the motors are swapped").waitFor();
    },
  ],
  "Set up, with a tuning": [
    "#setup",
    async (page) => {
      for (const each of await page.getByRole("checkbox").filter({ visible: true }).all()) await each.uncheck();
      await button(page, "Simulate this robot").click();
      await page.getByRole("button", { name: /^Speed control/ }).click();
      await press(page, "Speed control", "The floor is free: measure", panel(page, "Speed control").getByRole("table"));
    },
  ],
  "Set up, with the choice of ground truths": [
    "#setup",
    async (page) => {
      await button(page, "Simulate this robot").click();
      await page.getByRole("button", { name: /^Ground truth/ }).click();
    },
  ],
  "Set up, at its end": [
    "#setup",
    async (page) => {
      await button(page, "Simulate this robot").click();
      for (let i = 0; i < 7; ++i) await button(page, "Skip this step").click();
      await button(page, "Save this robot's page").waitFor();
    },
  ],
  "Live, before a robot": [
    "#live",
    async (page) => {
      await page.getByText("How it is built").click();
    },
  ],
  "Live, with an armed robot": [
    "#live",
    async (page) => {
      await simulate(page);
      await arm(page);
      await panel(page, "Scope").getByText("Signals:").click();
    },
  ],
  "Live, with a fault, a staged parameter, one that was refused, and the question before a commit": [
    "#live",
    async (page) => {
      await simulate(page);
      await page.keyboard.press("Space");
      await in_mode(page, "fault");
      for (const [name, value] of [["kp", "1e9"], ["command_timeout", "0"]]) {
        const field = panel(page, "Parameters").getByLabel(name, { exact: true });
        await field.fill(value);
        await field.press("Enter");
      }
      await button(page, "Commit").click();
      await page.getByRole("dialog").waitFor();
    },
  ],
};

/** Colours change over some tenths of a second, and those on the way are nobody's choice. */
const transitions_ended = (page) =>
  page.evaluate(() => Promise.allSettled(document.getAnimations().filter((each) => each instanceof CSSTransition).map((each) => each.finished)).then(() => {}));

for (const [name, [hash, prepare]] of Object.entries(pages))
  test(`${name}: light and dark, wide and 390 px, nothing is found by axe-core and nothing is wider than the window`, async () => {
    await in_browser(hash, {}, async (page) => {
      await prepare(page);
      for (const colorScheme of ["light", "dark"])
        for (const width of [1280, 390]) {
          await page.emulateMedia({ colorScheme });
          await page.setViewportSize({ width, height: 900 });
          await transitions_ended(page);
          assert.deepEqual(await findings(page), [], `${colorScheme}, ${width} px`);
          const wide = await page.evaluate(() => document.documentElement.scrollWidth);
          assert.ok(wide <= width, `${wide} px wide in a window of ${width} px`);
        }
    });
  });

/** Presses Tab until `wanted` has the focus. Whatever has it on the way must show that it has. */
async function tab_to(page, wanted) {
  for (let i = 0; i < 200; ++i) {
    await page.keyboard.press("Tab");
    const shows = await page.evaluate(() => {
      const style = getComputedStyle(document.activeElement);
      return document.activeElement === document.body || style.outlineStyle !== "none" || style.boxShadow !== "none";
    });
    assert.ok(shows, `the focus is not seen on ${await page.evaluate(() => document.activeElement.outerHTML.slice(0, 120))}`);
    if (await wanted.evaluate((element) => element === document.activeElement)) return;
  }
  assert.fail(`Tab does not lead to ${wanted}`);
}

test("with the keyboard alone a robot is calibrated, and files are", async () => {
  await in_browser("", {}, async (page) => {
    await tab_to(page, page.getByRole("spinbutton", { name: "Which robot" }));
    await page.keyboard.press("ArrowUp");
    await tab_to(page, page.getByRole("button", { name: "Drive and calibrate" }));
    await page.keyboard.press("Enter");
    await page.getByRole("region", { name: "Result" }).waitFor({ timeout: 120_000 });
    await page.reload();
    await tab_to(page, page.getByRole("link", { name: "Your data" }));
    await page.keyboard.press("Enter");
    const choose = page.getByLabel("Drop files");
    await tab_to(page, choose);
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.keyboard.press("Space")]);
    await chooser.setFiles(drive_files());
    await page.getByRole("heading", { name: "Drives" }).waitFor({ timeout: 60_000 });
    for (const label of ["Wheelbase, mm", "Wheel diameter", "Counts per turn"]) {
      await tab_to(page, page.getByLabel(label));
      await page.keyboard.type(sizes[label]);
    }
    await tab_to(page, page.getByRole("button", { name: "Calibrate", exact: true }));
    await page.keyboard.press("Enter");
    const result = page.getByRole("region", { name: "Result" });
    await result.or(page.getByRole("alert")).first().waitFor({ timeout: 60_000 });
    assert.equal(await page.getByRole("alert").count(), 0, (await page.getByRole("alert").allInnerTexts()).join("; "));
    // The robot is exactly as its sizes say; one minute shows that to far better than this.
    const row = await result.getByRole("row", { name: /^b mm/ }).innerText();
    assert.ok(Math.abs(Number(row.split("\t")[2]) - 290) < 1, row);
  });
});

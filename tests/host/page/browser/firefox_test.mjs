// Both pages in Debian's Firefox.
import assert from "node:assert/strict";
import { test } from "node:test";
import { in_browser } from "./browser.mjs";
import { drive_files, sizes } from "./drive_files.mjs";

const engine = "firefox";

test("Firefox drives a simulated robot, calibrates it and shows the report", async () => {
  await in_browser("#try", { engine }, async (page) => {
    await page.getByRole("button", { name: "Drive and calibrate" }).click();
    await page.getByRole("region", { name: "Result" }).waitFor({ timeout: 240_000 });
    assert.match(await page.getByRole("region", { name: "Result" }).innerText(), /improvement factor/);
    assert.match(await page.locator("iframe[title=Report]").getAttribute("srcdoc"), /<html/i);
  });
});

test("Firefox calibrates from two files", async () => {
  await in_browser("#data", { engine }, async (page) => {
    await page.getByLabel("Drop files").setInputFiles(drive_files());
    await page.getByRole("heading", { name: "Drives" }).waitFor({ timeout: 120_000 });
    for (const [label, value] of Object.entries(sizes)) await page.getByLabel(label).fill(value);
    await page.getByRole("button", { name: "Calibrate", exact: true }).click();
    const result = page.getByRole("region", { name: "Result" }).filter({ visible: true });
    await result.waitFor({ timeout: 240_000 });
    // The robot is exactly as its sizes say; one minute shows that to far better than this.
    const row = await result.getByRole("row", { name: /^b mm/ }).innerText();
    assert.ok(Math.abs(Number(row.split("\t")[2]) - 290) < 1, row);
  });
});

// The page Live on a robot that the module simulates, as somebody uses it who has only the page.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { test } from "node:test";
import { astrolabe } from "../module/places.mjs";
import { in_browser } from "./browser.mjs";
import { expect_smooth, watch_for_a_minute } from "./live_load.mjs";
import { arm, at_rest, beyond, button, forward_m, in_mode, no_complaint, pad, panel, simulate, strip } from "./live.mjs";

/** An armed simulated robot on the page Live. */
const on_armed_robot = (use, options = {}) =>
  in_browser("#live", options, async (page) => {
    await simulate(page);
    await arm(page);
    await use(page);
  });

/** Holds the arrow key until the robot has come 10 cm further, and keeps it. */
async function hold_arrow(page) {
  const from_m = await forward_m(page);
  await pad(page).focus();
  await page.keyboard.down("ArrowUp");
  await beyond(page, from_m + 0.1);
}

test("the robot drives while an arrow key is held, rests when it is let go, and drives again without being armed anew", async () => {
  await on_armed_robot(async (page) => {
    for (let i = 0; i < 2; ++i) {
      await hold_arrow(page);
      await page.keyboard.up("ArrowUp");
      await at_rest(page);
      await in_mode(page, "armed");
    }
    await no_complaint(page);
  });
});

test("the robot drives while the pad is held, and rests when the pointer is let go", async () => {
  await on_armed_robot(async (page) => {
    const { x, y, width, height } = await pad(page).boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2, y + 4);
    await beyond(page, 0.1);
    await page.mouse.up();
    await at_rest(page);
    await no_complaint(page);
  });
});

const interruptions = {
  "the pad loses the focus": (page) => page.evaluate(() => document.activeElement.blur()),
  "the window loses the focus": (page) => page.evaluate(() => dispatchEvent(new Event("blur"))),
  "the tab is hidden": (page) =>
    page.evaluate(() => {
      Object.defineProperty(document, "hidden", { value: true, configurable: true });
      document.dispatchEvent(new Event("visibilitychange"));
    }),
  "another page is turned to": (page) => page.getByRole("link", { name: "Try" }).click(),
};
for (const [what, interrupt] of Object.entries(interruptions))
  test(`the robot stops and has to be armed again when ${what} while a key is held`, async () => {
    await on_armed_robot(async (page) => {
      await hold_arrow(page);
      await interrupt(page);
      await page.evaluate(() => (location.hash = "#live"));
      await at_rest(page);
      const rests_m = await forward_m(page);
      await page.keyboard.up("ArrowUp");
      await button(page, "Arm again").click();
      await hold_arrow(page);
      await page.keyboard.up("ArrowUp");
      assert.ok((await forward_m(page)) > rests_m);
    });
  });

test("a pointer that the system takes away stops the robot", async () => {
  await on_armed_robot(async (page) => {
    const { x, y, width } = await pad(page).boundingBox();
    await page.mouse.move(x + width / 2, y + 4);
    await page.mouse.down();
    await beyond(page, 0.1);
    await pad(page).evaluate((element) => element.dispatchEvent(new PointerEvent("pointercancel", { pointerId: 1, bubbles: true })));
    await button(page, "Arm again").waitFor();
    await at_rest(page);
    await page.mouse.up();
  });
});

test("the space bar stops the robot on every page, whatever has the focus, and presses nothing", async () => {
  await in_browser("#live", {}, async (page) => {
    await simulate(page);
    const focused = [
      ["#live", () => button(page, "Disarm")],
      ["#live", () => pad(page)],
      ["#live", () => page.getByLabel("Parameters with this word")],
      ["#try", () => button(page, "Drive and calibrate")],
      ["#data", () => page.getByLabel("Drop files")],
      ["#data", () => page.getByRole("link", { name: "Live" })],
    ];
    for (const [at, element] of focused) {
      await page.evaluate(() => (location.hash = "#live"));
      await arm(page);
      await page.evaluate((hash) => (location.hash = hash), at);
      await element().focus();
      await page.keyboard.press("Space");
      await in_mode(page, "fault");
      assert.equal(await page.evaluate(() => location.hash), at);
      assert.equal(await page.getByText("Driving", { exact: true }).count(), 0, "Drive and calibrate was pressed");
      await page.evaluate(() => (location.hash = "#live"));
      await panel(page, "Faults").getByText("emergency stop", { exact: true }).waitFor();
      await button(page, "Clear").first().click();
      await in_mode(page, "disarmed");
    }
  });
});

test("the emergency stop is on every page and takes the power off a driving robot", async () => {
  await on_armed_robot(async (page) => {
    await panel(page, "Drive").getByLabel("Side, m").fill("2");
    await button(page, "Drive it").click();
    await beyond(page, 0.1);
    await page.getByRole("link", { name: "Your data" }).click();
    await strip(page).getByRole("button", { name: /STOP/ }).click();
    await in_mode(page, "fault");
    await page.getByRole("link", { name: "Live" }).click();
    await at_rest(page);
  });
});

test("a square is driven to its end, paused and continued on the way, and truth and odometry end apart", async () => {
  await on_armed_robot(async (page) => {
    await panel(page, "Drive").getByLabel("Side, m").fill("0.3");
    await button(page, "Drive it").click();
    await beyond(page, 0.05);
    await panel(page, "Drive").getByRole("button", { name: "Pause" }).click();
    await in_mode(page, "paused");
    await panel(page, "Drive").getByRole("button", { name: "Go on" }).click();
    await page.getByLabel("Part of the path that is driven").waitFor({ state: "detached", timeout: 60_000 });
    await in_mode(page, "armed");
    await no_complaint(page);
    // The simulated robot's wheels differ by 0.4 %, which turns it by some tenths of a degree in a square.
    const apart = await panel(page, "Path").locator("data").nth(1).innerText();
    assert.ok(Number(apart.split(" ")[0]) > 0, apart);
  });
});

test("parameters are staged, discarded, committed, refused beyond their limits, and asked about where people are mostly wrong", async () => {
  await in_browser("#live", {}, async (page) => {
    await simulate(page);
    const field = (name) => panel(page, "Parameters").getByLabel(name, { exact: true });
    const enter = async (name, value) => {
      await field(name).fill(value);
      await field(name).press("Enter");
    };
    const usual = await field("kp").inputValue();
    await enter("kp", "61");
    await page.getByText("1 change is staged").waitFor();
    await button(page, "Discard").click();
    await page.getByText("1 change is staged").waitFor({ state: "detached" });
    assert.equal(await field("kp").inputValue(), usual);
    await enter("kp", "1e9");
    await panel(page, "Parameters").getByRole("alert").filter({ hasText: "kp" }).waitFor();
    await enter("kp", "62");
    await button(page, "Commit").click();
    await page.getByText("is staged").waitFor({ state: "detached" });
    assert.equal(await field("kp").inputValue(), "62");
    await enter("command_timeout", "0");
    await button(page, "Commit").click();
    await page.getByRole("dialog").waitFor();
    await page.keyboard.press("Escape");
    await page.getByText("1 change is staged").waitFor();
    await button(page, "Commit").click();
    await page.getByRole("dialog").getByRole("button", { name: "Commit all the same" }).click();
    await page.getByText("is staged").waitFor({ state: "detached" });
    await page.reload();
    await simulate(page);
    assert.equal(await field("kp").inputValue(), usual, "another simulated robot has its own parameters");
  });
});

test("the scope shows up to 20 signals, waits for its trigger, pauses, and tells values at a cursor", async () => {
  await on_armed_robot(async (page) => {
    const scope = panel(page, "Scope");
    await scope.getByText("Signals:").click();
    for (const group of await scope.locator(".groups > div").all()) {
      const all = group.getByRole("button").first();
      if ((await all.getAttribute("aria-pressed")) === "false") await all.click();
    }
    assert.equal(await scope.locator(".values li").count(), 20);
    await scope.getByRole("combobox", { name: "Trigger", exact: true }).selectOption("once");
    await scope.getByRole("combobox", { name: "Signal", exact: true }).selectOption("left_speed");
    await scope.getByLabel("Level, m/s").fill("0.1");
    await scope.getByText("waiting for the trigger").waitFor();
    await hold_arrow(page);
    await page.keyboard.up("ArrowUp");
    await scope.getByRole("button", { name: "Go on" }).waitFor({ timeout: 30_000 });
    // A fifth of the window lies before the trigger: at the cursor there the speed crosses the level.
    const cursor = scope.getByRole("slider", { name: "Cursor of the scope" });
    const { width } = await cursor.boundingBox();
    const [left, right] = [58, 8];
    await cursor.hover({ position: { x: left + 0.2 * (width - left - right), y: 50 } });
    const at_cursor = Number(await scope.locator(".values li", { hasText: "left speed" }).locator("data").innerText());
    // A pixel of 5 s in 1000 px is 5 ms, in which the robot gains 2.5 mm/s at 0.5 m/s^2; its speed is measured with some mm/s of noise.
    assert.ok(Math.abs(at_cursor - 0.1) < 0.03, `${at_cursor} m/s at the trigger`);
  });
});

test("what was recorded is saved as MCAP", async () => {
  await on_armed_robot(async (page) => {
    await button(page, "Record").click();
    await strip(page).getByText("recording").waitFor();
    await hold_arrow(page);
    await page.keyboard.up("ArrowUp");
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: /Save as MCAP/ }).click()]);
    assert.match(download.suggestedFilename(), /\.mcap$/);
    const bytes = readFileSync(await download.path());
    const magic = Buffer.from("\x89MCAP0\r\n", "latin1");
    assert.ok(bytes.subarray(0, 8).equals(magic) && bytes.subarray(-8).equals(magic), "the file is complete");
    assert.ok(bytes.includes("left_setpoint"), "it describes what was watched");
  });
});

test("a recording that the browser got is offered until a person removes it", async () => {
  await on_armed_robot(async (page) => {
    await button(page, "Record").click();
    await strip(page).getByText("recording").waitFor();
    const saved = async (from, name) => (await Promise.all([page.waitForEvent("download"), from.getByRole("button", { name }).click()]))[0];
    const first = await saved(page, /Save as MCAP/);
    // Whoever leaves the dialog without saving finds it here.
    const recordings = panel(page, "Recordings");
    await recordings.getByText("given to the browser").waitFor();
    const again = await saved(recordings, /^Save again/);
    assert.ok(readFileSync(await again.path()).equals(readFileSync(await first.path())));
    await recordings.getByRole("button", { name: /^Remove/ }).click();
    await recordings.waitFor({ state: "detached" });
  });
});

test("a browser that keeps nothing for the page says so when a recording begins", async () => {
  const without_storage = async (page) => {
    await page.route("**/wasm_worker*.js", async (route) => {
      const response = await route.fetch();
      const refuses = "navigator.storage.getDirectory = () => Promise.reject(new DOMException('', 'SecurityError'));";
      await route.fulfill({ response, body: refuses + (await response.text()) });
    });
    await page.reload();
  };
  await in_browser("#live", {}, async (page) => {
    await without_storage(page);
    await simulate(page);
    await button(page, "Record").click();
    await page.getByText("keeps nothing for this page").waitFor();
  });
});

test("what was recorded is not lost with the page", async () => {
  await on_armed_robot(async (page) => {
    const folder = mkdtempSync(path.join(os.tmpdir(), "page-recording-"));
    try {
      await button(page, "Record").click();
      await strip(page).getByText("recording").waitFor();
      await hold_arrow(page);
      const recordings = panel(page, "Recordings");
      const [other] = await Promise.all([page.waitForEvent("popup"), page.evaluate(() => void open(location.href))]);
      await button(other, "Simulate a robot").waitFor();
      assert.equal(await panel(other, "Recordings").count(), 0, "no other page offers what is being recorded");
      await other.close();
      // The page copies once a second what the module has written: 2 KB of definitions at first, then 70 KB of what was driven, once in
      // some seconds.
      const copied_bytes = () =>
        page.evaluate(async () => {
          const folder = await (await navigator.storage.getDirectory()).getDirectoryHandle("recordings");
          let bytes = 0;
          for await (const file of folder.values()) bytes += (await file.getFile()).size;
          return bytes;
        });
      while ((await copied_bytes()) < 20_000) await page.waitForTimeout(200);
      await page.reload();
      await recordings.waitFor();
      const [download] = await Promise.all([page.waitForEvent("download"), recordings.getByRole("button", { name: /^Save/ }).click()]);
      const saved = path.join(folder, download.suggestedFilename());
      await download.saveAs(saved);
      execFileSync(astrolabe, ["export", saved, "--damaged", "--csv", path.join(folder, "csv")]);
      const odometry = readFileSync(path.join(folder, "csv", "odometry.csv"), "utf8").trim().split("\n");
      assert.ok(odometry.length > 50, `${odometry.length} lines`);
      await recordings.getByRole("button", { name: /^Remove/ }).click();
      await recordings.waitFor({ state: "detached" });
      await page.reload();
      await button(page, "Simulate a robot").waitFor();
      assert.equal(await recordings.count(), 0, "what is removed is not offered again");
    } finally {
      rmSync(folder, { recursive: true });
    }
  });
});

test("a recording that ends with its robot is offered, saved or discarded", async () => {
  await on_armed_robot(async (page) => {
    const recordings = panel(page, "Recordings");
    for (const what of [/^Save/, /^Discard/]) {
      await button(page, "Record").click();
      await strip(page).getByText("recording").waitFor();
      await button(page, "Leave this robot").click();
      await recordings.waitFor();
      await recordings.getByRole("button", { name: what }).click();
      if (String(what).includes("Save")) await recordings.getByRole("button", { name: /^Remove/ }).click();
      await recordings.waitFor({ state: "detached" });
      await simulate(page);
    }
  });
});

test("with the keyboard alone a robot is simulated, armed, driven and stopped", async () => {
  await in_browser("#live", {}, async (page) => {
    const press = async (wanted) => {
      for (let i = 0; i < 300; ++i) {
        await page.keyboard.press("Tab");
        if (await wanted.evaluateAll(([element]) => element === document.activeElement)) return page.keyboard.press("Enter");
      }
      assert.fail(`Tab does not lead to ${wanted}`);
    };
    await press(button(page, "Simulate a robot"));
    await in_mode(page, "disarmed");
    await press(button(page, "Arm"));
    await in_mode(page, "armed");
    await press(pad(page));
    await page.keyboard.down("ArrowUp");
    await beyond(page, 0.1);
    await page.keyboard.up("ArrowUp");
    await at_rest(page);
    await page.keyboard.press("Space");
    await in_mode(page, "fault");
  });
});

test("by touch the pad drives, and a lifted finger rests the robot", async () => {
  await on_armed_robot(
    async (page) => {
      await pad(page).scrollIntoViewIfNeeded();
      const { x, y, width } = await pad(page).boundingBox();
      const touch = await page.context().newCDPSession(page);
      await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x: x + width / 2, y: y + 6 }] });
      await beyond(page, 0.1);
      await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
      await at_rest(page);
      await in_mode(page, "armed");
      await no_complaint(page);
    },
    { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true },
  );
});

test("20 signals at 1 kHz are drawn for a minute within a picture's time and in the same memory", async () => {
  await in_browser("#live", {}, async (page) => {
    await simulate(page);
    await arm(page);
    expect_smooth(await watch_for_a_minute(page));
  });
});

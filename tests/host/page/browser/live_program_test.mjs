// The page Live as a program serves it.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { test } from "node:test";
import { astrolabe } from "../module/places.mjs";
import { in_window } from "./browser.mjs";
import { arm, at_rest, beyond, button, in_mode, pad, simulate, strip } from "./live.mjs";
import { expect_smooth, watch_for_a_minute } from "./live_load.mjs";
import { program_time_s } from "./processor_time.mjs";
import { ended, with_dashboard, with_robot } from "./programs.mjs";

test("reloading the page in the middle of a drive stops the robot, as another page sees", async () => {
  await with_dashboard([], async (link) => {
    await in_window(link, {}, async (page) => {
      await simulate(page);
      await arm(page);
      const other = await page.context().browser().newPage();
      await other.goto(link);
      await in_mode(other, "armed");
      await page.bringToFront();
      await pad(page).focus();
      await page.keyboard.down("ArrowUp");
      await beyond(other, 0.1);
      await page.reload();
      await at_rest(other);
      await in_mode(other, "disarmed");
      await in_mode(page, "disarmed");
      await arm(other);
    });
  });
});

test("a page that does not drive the robot says who does, and stops it all the same", async () => {
  await with_dashboard([], async (link) => {
    await in_window(link, {}, async (page) => {
      await simulate(page);
      await arm(page);
      const other = await page.context().browser().newPage();
      await other.goto(link);
      await other.getByText("Another page drives the robot.").waitFor();
      await button(other, "Arm").click();
      await strip(other).getByRole("alert").getByText(/another page/).waitFor();
      await button(page, "Drive it").click();
      await beyond(page, 0.1);
      await strip(other).getByRole("button", { name: /STOP/ }).click();
      await in_mode(page, "fault");
      await at_rest(page);
    });
  });
});

test("a robot that is lost is said to be lost, and is there again when it is", async () => {
  await with_robot(async (robot) => {
    await with_dashboard(["--port", robot.path], async (link) => {
      await in_window(link, {}, async (page) => {
        await in_mode(page, "disarmed");
        await arm(page);
        await robot.lose();
        await in_mode(page, "lost");
        assert.ok(await button(page, "Arm").isDisabled());
        await robot.start();
        await in_mode(page, "disarmed");
        await arm(page);
        await pad(page).focus();
        await page.keyboard.down("ArrowUp");
        await beyond(page, 0.1);
        await page.keyboard.up("ArrowUp");
      });
    });
  });
});

test("a program that ends is said to have ended", async () => {
  const may_complain = (text) => /WebSocket connection to .* failed/.test(text);
  await with_dashboard([], async (link, program) => {
    await in_window(link, { may_complain }, async (page) => {
      await simulate(page);
      await ended(program);
      await in_mode(page, "lost");
      await strip(page).getByText(/open the link that it prints/).waitFor();
    });
  });
});

test("what is recorded goes on while the page is reloaded, and is kept when Ctrl-C ends the program", async () => {
  const may_complain = (text) => /WebSocket connection to .* failed/.test(text);
  const kept = mkdtempSync(path.join(os.tmpdir(), "page-kept-"));
  try {
    await with_dashboard(["--recordings", kept], async (link, program) => {
      await in_window(link, { may_complain }, async (page) => {
        await simulate(page);
        await button(page, "Record").click();
        await strip(page).getByText("recording").waitFor();
        await page.reload();
        await strip(page).getByText("recording").waitFor();
        await ended(program, "SIGINT");
        await in_mode(page, "lost");
      });
    });
    const [recording, ...others] = readdirSync(kept);
    assert.match(recording, /\.mcap$/);
    assert.deepEqual(others, []);
    execFileSync(astrolabe, ["export", path.join(kept, recording), "--csv", path.join(kept, "csv")]);
  } finally {
    rmSync(kept, { recursive: true });
  }
});

test("the link's token leaves the address, and without it nothing is answered", async () => {
  const may_complain = (text) => /WebSocket|401/.test(text);
  await with_dashboard([], async (link) => {
    await in_window(link, { may_complain }, async (page) => {
      await button(page, "Simulate a robot").waitFor();
      assert.doesNotMatch(page.url(), /token/);
      await page.goto("about:blank");
      await page.goto(link.replace(/token=.*/, "token=0123"));
      await page.getByRole("alert").getByText(/this is not the token of this session/).first().waitFor();
    });
  });
});

test("Try gives its report when a program answers", async () => {
  await with_dashboard([], async (link) => {
    await in_window(link, {}, async (page) => {
      await page.getByRole("link", { name: "Try" }).click();
      await button(page, "Drive and calibrate").click();
      await page.frameLocator("iframe[title=Report]").locator("h1").waitFor({ timeout: 120_000 });
    });
  });
});

test("20 signals at 1 kHz for a minute take at most a tenth of a core of the program", async () => {
  await with_robot(async (robot) => {
    await with_dashboard(["--port", robot.path], async (link, program) => {
      await in_window(link, {}, async (page) => {
        await in_mode(page, "disarmed");
        await arm(page);
        let before_s = 0;
        const took = await watch_for_a_minute(page, () => (before_s = program_time_s(program.pid)));
        const share = (program_time_s(program.pid) - before_s) / took.seconds;
        console.log(`the program took ${(100 * share).toFixed(1)} % of a core`);
        expect_smooth(took);
        assert.ok(share <= 0.1, `${100 * share} % of a core`);
      });
    });
  });
});

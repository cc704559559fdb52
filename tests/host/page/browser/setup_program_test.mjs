// The page Set up as a program serves it.
import { test } from "node:test";
import { in_window } from "./browser.mjs";
import { with_dashboard } from "./programs.mjs";
import { expect_mended, set_up } from "./setup.mjs";

const steps = (page) => page.getByRole("navigation", { name: "Steps" });

test("a robot that the program simulates is set up, and after a reload the page is where it was", async () => {
  await with_dashboard([], async (link) => {
    await in_window(link, {}, async (page) => {
      await page.getByRole("link", { name: "Set up" }).click();
      await set_up(page, async () => {
        await page.reload();
        await steps(page).waitFor({ timeout: 60_000 });
      });
      await expect_mended(page);
    });
  });
});

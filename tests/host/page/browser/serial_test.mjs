// A robot at a port of the browser, without any program of ours: the module in the page drives it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { in_browser } from "./browser.mjs";
import { arm, at_rest, beyond, button, in_mode, no_complaint, pad, panel, strip } from "./live.mjs";
import { with_robot } from "./programs.mjs";
import { with_serial_port } from "./serial_port.mjs";

/** A page that may use ports, with a robot at one. */
const beside_robot = (wanted, use) =>
  with_robot((robot) =>
    in_browser(wanted, { isolated: true }, async (page) => {
      await with_serial_port(page, robot);
      await use(page, robot);
    }),
  );

async function choose(page) {
  await button(page, "Choose a port").click();
  await in_mode(page, "disarmed");
}

test("a robot at a port is opened, driven and stopped", async () => {
  await beside_robot("#live", async (page) => {
    await choose(page);
    await arm(page);
    for (let i = 0; i < 2; ++i) {
      await pad(page).focus();
      await page.keyboard.down("ArrowUp");
      await beyond(page, 0.1 * (i + 1));
      await page.keyboard.up("ArrowUp");
      await at_rest(page);
    }
    await no_complaint(page);
    await strip(page).getByRole("button", { name: /STOP/ }).click();
    await in_mode(page, "fault");
  });
});

test("a robot whose cable is pulled is said to be lost, and is there again when it is", async () => {
  await beside_robot("#live", async (page, robot) => {
    await choose(page);
    await robot.lose();
    await in_mode(page, "lost");
    assert.ok(await button(page, "Arm").isDisabled());
    await robot.start();
    await in_mode(page, "disarmed");
    // Its parameters are read first, and the button goes when it is armed.
    while (!(await strip(page).getByText("armed", { exact: true }).isVisible())) {
      await button(page, "Arm").click({ timeout: 1000 }).catch(() => {});
      await page.waitForTimeout(200);
    }
  });
});

test("a port that was chosen before is offered again", async () => {
  await beside_robot("#live", async (page) => {
    await choose(page);
    await page.reload();
    await page.getByRole("button", { name: /USB 16c0:0483/ }).click();
    await in_mode(page, "disarmed");
  });
});

test("a measurement of a robot at a port is ended by the emergency stop", async () => {
  await beside_robot("#setup", async (page) => {
    await button(page, "Choose a port").click();
    for (const step of ["Wires", "Counts per turn", "Wheels and wheelbase"]) await panel(page, step).getByRole("button", { name: "Skip this step" }).click();
    await panel(page, "Speed control").getByRole("button", { name: "The floor is free: measure" }).click();
    await in_mode(page, "measuring");
    await strip(page).getByRole("button", { name: /STOP/ }).click();
    await in_mode(page, "fault");
    await panel(page, "Speed control").getByRole("button", { name: "The floor is free: measure" }).waitFor();
  });
});

test("a stop that comes with a measurement overtakes it, and nothing is driven", async () => {
  await beside_robot("#setup", async (page) => {
    await button(page, "Choose a port").click();
    for (const step of ["Wires", "Counts per turn", "Wheels and wheelbase"]) await panel(page, step).getByRole("button", { name: "Skip this step" }).click();
    const step = panel(page, "Speed control");
    const both = [step.getByRole("button", { name: "The floor is free: measure" }), strip(page).getByRole("button", { name: /STOP/ })];
    const [measure, stop] = await Promise.all(both.map((each) => each.elementHandle()));
    await page.evaluate(([measure, stop]) => (measure.click(), stop.click()), [measure, stop]);
    await step.getByText("it was not carried out: the robot was stopped").waitFor();
    await in_mode(page, "fault");
  });
});

test("a page from any web server may use a port once it has loaded anew", async () => {
  await with_robot((robot) =>
    in_browser("#live", {}, async (page) => {
      await with_serial_port(page, robot);
      await button(page, "Use a serial port").click();
      await choose(page);
    }),
  );
});

test("a browser without serial ports says which have them", async () => {
  const none = () => Object.defineProperty(navigator, "serial", { value: undefined });
  await in_browser("#live", { isolated: true, init: none }, async (page) => {
    await page.getByText("current Chrome, Edge and Firefox do").filter({ visible: true }).waitFor();
  });
});

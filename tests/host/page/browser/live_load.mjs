// What the page Live takes with all that it can show, for a minute.
import assert from "node:assert/strict";
import { setTimeout as wait } from "node:timers/promises";
import { button, panel } from "./live.mjs";
import { page_thread_clock } from "./processor_time.mjs";

const kSeconds = 60;
/** Until the code is compiled and the path is as long as is kept. The scope's memory is taken at once. */
const kWarmUp_s = 10;

const quantile = (values, part) => [...values].sort((a, b) => a - b)[Math.floor(part * (values.length - 1))];
const ms = (values) => `mean ${(values.reduce((a, b) => a + b, 0) / values.length).toFixed(1)}, p95 ${quantile(values, 0.95).toFixed(1)}, worst ${Math.max(...values).toFixed(1)} ms`;

/** Notes when each picture is begun, in memory that is there from the beginning. */
const note_frames = (page) =>
  page.evaluate(() => {
    globalThis.frames_of_test = { count: 0, at_ms: new Float64Array(100_000) };
    const frame = (now) => {
      const { frames_of_test: all } = globalThis;
      all.at_ms[all.count++] = performance.timeOrigin + now;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });

/** What the thread computed for a sixtieth of a second, in each second. */
const work_of_pictures = (computed_ms) => computed_ms.slice(1).map((now, i) => (now - computed_ms[i]) / 60);

async function heap_bytes(session) {
  await session.send("HeapProfiler.collectGarbage");
  return (await session.send("Runtime.getHeapUsage")).usedSize;
}

async function show_all_signals(page) {
  const scope = panel(page, "Scope");
  await scope.getByLabel("Rate").selectOption("1000");
  await scope.getByText("Signals:").click();
  for (const group of await scope.locator(".groups > div").all()) {
    const all = group.getByRole("button").first();
    if ((await all.getAttribute("aria-pressed")) === "false") await all.click();
  }
  assert.equal(await scope.locator(".values li").count(), 20);
}

/** Shows the armed robot's 20 signals at 1 kHz while it drives a square; prints and answers what that took, from when `begun` is called. */
export async function watch_for_a_minute(page, begun = () => {}) {
  await show_all_signals(page);
  await panel(page, "Drive").getByLabel("Side, m").fill("10");
  await button(page, "Drive it").click();
  await wait(1000 * kWarmUp_s);
  const session = await page.context().newCDPSession(page);
  const before = await heap_bytes(session);
  await note_frames(page);
  const clock_ms = page_thread_clock();
  const computed_ms = [clock_ms()];
  begun();
  for (let second = 0; second < kSeconds; ++second) {
    await wait(1000);
    computed_ms.push(clock_ms());
  }
  const frames_ms = await page.evaluate(() => [...globalThis.frames_of_test.at_ms.subarray(0, globalThis.frames_of_test.count)]);
  const after = await heap_bytes(session);
  const work_ms = work_of_pictures(computed_ms);
  const apart_ms = frames_ms.slice(1).map((at, i) => at - frames_ms[i]);
  assert.match(await panel(page, "Scope").locator(".values data").first().innerText(), /\d/, "the scope shows values");
  console.log(`${frames_ms.length} pictures, apart ${ms(apart_ms)}; the page's own thread computed in a sixtieth of a second ${ms(work_ms)}, for each picture ${((computed_ms.at(-1) - computed_ms[0]) / frames_ms.length).toFixed(1)} ms; heap ${(before / 1e6).toFixed(1)} MB, a minute later ${(after / 1e6).toFixed(1)} MB`);
  return { work_ms, grown: after - before, seconds: kSeconds };
}

/** How far pictures are apart says how busy the machine is. The page itself may take half of a picture's 16.7 ms; the rest is for the browser, which puts it onto the screen. */
export function expect_smooth({ work_ms, grown }) {
  assert.ok(quantile(work_ms, 0.95) <= 8.3, `p95 of ${quantile(work_ms, 0.95)} ms in the time of a picture`);
  // The path keeps some more points, and the collector's figures wander by some 100 kB.
  assert.ok(grown <= 1e6, `the heap has grown by ${grown} bytes`);
}

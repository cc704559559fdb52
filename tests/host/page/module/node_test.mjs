// What the firmware and the simulated robot compute on the module's processor, without the module: under node.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { native_programs, node_programs } from "./places.mjs";

// Emscripten 3.1.6 would fetch its .wasm from a file: address, which node does not do.
const under_node = (name, ...words) =>
  execFileSync(process.execPath, ["--no-experimental-fetch", path.join(node_programs, name), ...words], { encoding: "utf8", maxBuffer: 1 << 26 });

test("two minutes of odometry and duty have the same bits as on this machine", () => {
  const native = execFileSync(path.join(native_programs, "replay_sums"), { encoding: "utf8" }).trim().split("\n");
  assert.equal(native.length, 120);
  assert.deepEqual(under_node("replay_sums.cjs").trim().split("\n"), native);
});

const suites = readdirSync(node_programs).filter((name) => name.endsWith(".test.cjs"));
test("there are unit tests for node", () => assert.ok(suites.length >= 2, suites.join(", ")));
for (const suite of suites)
  test(`${suite}: the unit tests pass`, () => {
    const said = under_node(suite, "--gtest_brief=1");
    const passed = Number(/\[  PASSED  \] (\d+) test/.exec(said)?.[1]);
    console.log(`${suite}: ${passed} tests`);
    assert.ok(passed > 0, said);
  });

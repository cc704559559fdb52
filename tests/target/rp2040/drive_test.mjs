import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bench, expectNoComplaints, open, print } from './bench.mjs';
import { id, mode } from './rig/host.mjs';

const kLine = 0, kSpin = 1;

test('a square of 0.3 m comes home, counted by the decoders edge for edge', () => {
  const { pico, robot, host } = bench();
  host.hello();
  host.request(id.arm);
  for (let side = 0; side < 4; ++side) {
    host.segment({ kind: kLine, tag: 2 * side + 1, length_m: 0.3 });
    host.segment({ kind: kSpin, tag: 2 * side + 2, turns: 0.25 });
    assert.equal(host.finished(2 * side + 1, 6000), 0);
    if (side === 0) assert.ok(Math.abs(host.pose().x_m - 0.3) < 0.002, 'the first side is driven');
    assert.equal(host.finished(2 * side + 2, 6000), 0);
  }
  for (let ms = 0; ms < 300; ++ms) host.advance(1);
  const pose = host.pose(), status = host.status();
  print(`home: x ${(pose.x_m * 1000).toFixed(2)} mm, y ${(pose.y_m * 1000).toFixed(2)} mm, heading ${((pose.turns - 1) * 360).toFixed(3)} deg; ` +
    `${status.ticks} ticks, longest gap ${status.longest_us} us`);
  // The path follower ends each segment within the reach of a count or two (0.08 mm) and of the wheels' dead time.
  assert.ok(Math.hypot(pose.x_m, pose.y_m) < 0.005);
  assert.ok(Math.abs(pose.turns - 1) < 0.002);
  assert.equal(status.overruns, 0);
  assert.ok(status.longest_us <= 1002, 'a tick is at most as late as the longest hold of interrupts');
  const machines = pico.chip.pio[0].machines;
  pico.chip.syncPio();
  assert.deepEqual([machines[0].x | 0, machines[1].x | 0], pico.counts);
  assert.ok(robot.travel[1] > 20000, 'the outer wheel has gone 2.1 m, which are 26,000 counts');
  expectNoComplaints(pico);
});

test('the robot stops and opens its bridges when its host falls silent', () => {
  const { pico, host } = bench();
  host.hello();
  host.request(id.arm);
  host.velocity(300000, 0);
  for (let ms = 0; ms < 100; ++ms) host.advance(1);
  assert.notDeepEqual(pico.bridges(), open);
  let ms = 0;
  while (ms < 3000 && pico.bridges().some((bridge) => bridge !== 'coast')) { host.advance(1); ++ms; }
  print(`bridges open ${ms} ms after the last word of the host`);
  assert.deepEqual(pico.bridges(), open);
  assert.equal(host.status().mode, mode.fault);
});

test('a motor feels one direction only, also when it is told to turn round', () => {
  const { pico, host } = bench();
  host.hello();
  host.request(id.arm);
  const seen = new Set();
  for (let change = 0; change < 8; ++change) {
    host.velocity(change % 2 ? -250000 : 250000, 0);
    for (let ms = 0; ms < 60; ++ms) {
      host.advance(1);
      for (const bridge of pico.bridges()) seen.add(typeof bridge === 'number' ? Math.sign(bridge) : bridge);
    }
  }
  assert.ok(seen.has(1) && seen.has(-1));
  assert.ok(!seen.has('mixed'), 'both inputs were low for a part of a period');
});

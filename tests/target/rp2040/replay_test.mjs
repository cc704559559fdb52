import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { test } from 'node:test';
import { expectNoComplaints, images, print } from './bench.mjs';
import { readUf2, symbolsOf } from './rig/image.mjs';
import { Pico } from './rig/pico.mjs';

const kTicks = 120000, kSums = 120;

test('two minutes of odometry and duty have the same bits here and on the Cortex-M0+', () => {
  const sums = execFileSync(process.env.ASTRO_REPLAY_SUMS, { encoding: 'utf8' }).trim().split('\n');
  assert.equal(sums.length, kSums);
  const symbols = symbolsOf(`${images}/replay.elf`);
  const pico = new Pico({ image: readUf2(`${images}/replay.uf2`) });
  while (pico.word(symbols.get('replay_done')) !== 1 && pico.now_ns < 60e9) pico.runFor(10e6);
  const found = Array.from({ length: kSums }, (_, i) => pico.word(symbols.get('replay_sums') + 4 * i).toString(16).padStart(8, '0'));
  assert.deepEqual(found, sums);
  assert.equal(new Set(found).size, kSums, 'each second has a sum of its own');
  print(`${kTicks} ticks, ${(pico.chip.instructions / kTicks).toFixed(0)} instructions and ${(pico.now_ns / 1000 / kTicks).toFixed(1)} us each, script and sums included`);
  expectNoComplaints(pico);
});

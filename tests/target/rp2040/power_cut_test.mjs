import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bench, print } from './bench.mjs';
import { NoAnswer } from './rig/host.mjs';

const kParameter = 1, kOld = (1 << 30) + 1111, kNew = (1 << 30) + 2222; // c_R
const kCuts = Number(process.env.ASTRO_POWER_CUTS ?? 24);
const kParametersAt = 0x1f0000, kSectors = 6;
const kCommits = 70;
const kSeed = 3;

// A flash that holds the old set, such that the next commit begins with erasing a sector full of older records, or does
// without; and how often that commit works on the flash.
function beforeACommit({ pico, host }, erases) {
  const commit = (value) => {
    const content = pico.flash.bytes.slice(), found = { content, count: 0, wiped: false };
    pico.chip.onFlashOperation = ({ at, size, bytes }) => {
      ++found.count;
      if (!bytes) found.wiped ||= content.subarray(at, at + size).some((byte) => byte !== 0xff);
    };
    host.commit(kParameter, value);
    pico.chip.onFlashOperation = null;
    return found;
  };
  let shifted = false;
  for (let commits = 0; commits < 60; ++commits) {
    // If a sector takes an even number of records the old set would begin each one. With an odd number they take turns.
    if (commit(kOld).wiped && erases && !shifted) {
      shifted = true;
      commit(kOld);
    }
    const found = commit(kNew);
    if (found.wiped === erases) return found;
  }
  throw new Error('no commit of this kind');
}

test('a supply that ends at any moment of a commit leaves the old set or the new one', () => {
  const { pico, host } = bench({ seed: kSeed });
  pico.flash.times = { erase: 2e6, program: 0.1e6 }; // what is proved is the order of work, not how long it takes
  host.hello();
  const starts = [beforeACommit({ pico, host }, true), beforeACommit({ pico, host }, false)];
  print(`seed ${kSeed}, ${kCuts} cuts; a commit works ${starts.map(({ count }) => count).join(' or ')} times on the flash`);
  let atErase = 0, within = 0, kept = 0, taken = 0;

  for (let cut = 0; cut < kCuts; ++cut) {
    const { content, count } = starts[cut % 2];
    pico.flash.bytes.set(content);
    pico.powerOn();
    host.hello();
    assert.equal(host.parameter(kParameter), kOld);
    const wanted = pico.flash.random() % count, part = (pico.flash.random() % 1000) / 1000;
    let seen = 0, operation = null;
    pico.chip.onFlashOperation = (started) => {
      if (seen++ !== wanted) return;
      operation = started;
      const { chip } = pico, alarm = chip.clock.createAlarm(() => { chip.ended = 'cut'; });
      alarm.schedule((started.until - chip.clock.nanos) * part);
    };
    let answered = true;
    try {
      host.commit(kParameter, kNew);
    } catch (error) {
      if (!(error instanceof NoAnswer)) throw error;
      answered = false;
    }
    assert.equal(pico.chip.ended, 'cut');
    ++within;
    if (!operation.bytes) ++atErase;
    pico.cutPower();
    pico.powerOn();
    host.hello();
    assert.equal(host.status().faults, 0, `cut ${cut}: the robot found no valid set`);
    const now = host.parameter(kParameter);
    assert.ok(now === kOld || now === kNew, `cut ${cut}: ${now} is neither the old set nor the new one`);
    if (answered) assert.equal(now, kNew, `cut ${cut}: a set that was acknowledged is lost`);
    if (now === kNew) ++taken;
    else ++kept;
  }
  print(`0 sets lost: ${within} cuts within the flash's work, ${atErase} of them at an erase; ${kept} kept the old set, ${taken} had the new one`);
  assert.ok(atErase > kCuts / 20 && kept > 0 && taken > 0);
});

test('parameters wear their sectors evenly, and the program is never erased', () => {
  const { pico, host } = bench({ seed: kSeed });
  pico.flash.times = { erase: 1e6, program: 0.05e6 };
  host.hello();
  for (let commit = 0; commit < kCommits; ++commit) host.commit(kParameter, (1 << 30) + commit);
  const wear = [...pico.flash.erasures].slice(kParametersAt / 4096, kParametersAt / 4096 + kSectors - 2);
  print(`erasures of the parameters' sectors after ${kCommits} commits: ${wear.join(' ')}`);
  assert.ok(Math.min(...wear) > 0 && Math.max(...wear) - Math.min(...wear) <= 1);
  assert.equal(pico.flash.erasures.subarray(0, kParametersAt / 4096).reduce((a, b) => a + b), 0);
});

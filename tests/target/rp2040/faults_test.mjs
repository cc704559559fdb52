import assert from 'node:assert/strict';
import { test } from 'node:test';
import { bench, expectNoComplaints, open, print, symbols } from './bench.mjs';
import { cause, Host, id, kWatchdogFault, mode } from './rig/host.mjs';
import { pins } from './rig/pico.mjs';

const kSpare = 0x20030000; // SRAM behind the program

function driving() {
  const all = bench();
  all.host.hello();
  all.host.request(id.arm);
  all.host.velocity(300000, 0);
  for (let ms = 0; ms < 100; ++ms) all.host.advance(1);
  assert.notDeepEqual(all.pico.bridges(), open);
  return all;
}

// The processor goes on with `code`, from the main loop or from the tick.
function derail({ pico }, exception, code) {
  const { chip } = pico;
  for (let i = 0; i < 1e6 && chip.core.IPSR !== exception; ++i) pico.runFor(100);
  assert.equal(chip.core.IPSR, exception);
  chip.core.waiting = false;
  chip.sramView.setUint16(kSpare - 0x20000000, code, true);
  chip.core.PC = kSpare;
}

function offAfter_ms({ pico }, step_ns = 10e3) {
  const begun = pico.now_ns;
  while (pico.now_ns - begun < 2e9 && pico.bridges().some((bridge) => bridge !== 'coast')) pico.runFor(step_ns);
  assert.deepEqual(pico.bridges(), open);
  return (pico.now_ns - begun) / 1e6;
}

function afterRestart({ pico }) {
  pico.runFor(1e9);
  assert.equal(pico.restarts, 1);
  assert.deepEqual(pico.bridges(), open, 'nothing drives again by itself');
  const again = new Host(pico);
  again.hello();
  return again.status();
}

const kForEver = 0xe7fe, kUndefined = 0xde00; // b .   udf #0
const kTick = 16;

test('a hung main loop ends by the watchdog: bridges open, restart, cause watchdog', () => {
  const all = driving();
  derail(all, 0, kForEver);
  const off_ms = offAfter_ms(all);
  print(`hung main loop: outputs off after ${off_ms.toFixed(0)} ms`);
  assert.ok(off_ms < 520);
  const status = afterRestart(all);
  assert.equal(status.cause, cause.watchdog);
  assert.equal(status.mode, mode.fault);
  assert.equal(status.faults, kWatchdogFault);
  expectNoComplaints(all.pico);
});

test('a hung tick ends by the watchdog, too', () => {
  const all = driving();
  derail(all, kTick, kForEver);
  const off_ms = offAfter_ms(all);
  print(`hung tick: outputs off after ${off_ms.toFixed(0)} ms`);
  assert.ok(off_ms < 520);
  assert.equal(afterRestart(all).cause, cause.watchdog);
});

test('an undefined instruction opens the bridges at once, and the next start reports a fault', () => {
  for (const exception of [0, kTick]) {
    const all = driving();
    derail(all, exception, kUndefined);
    const off_us = offAfter_ms(all, 100) * 1000;
    print(`undefined instruction in ${exception ? 'the tick' : 'the main loop'}: outputs off after ${off_us.toFixed(1)} us`);
    assert.ok(off_us <= (exception ? 1 : 100), 'a tick may come first, but not into a tick');
    all.pico.runFor(10e3);
    const { scratchData } = all.pico.chip.watchdog;
    const status = afterRestart(all);
    assert.equal(status.cause, cause.fault);
    assert.equal(scratchData[2], kSpare, 'where it happened');
    assert.equal(status.faults, kWatchdogFault);
  }
});

test('a stack that outgrows its memory touches nobody\'s data: the core locks up and the watchdog restarts it', () => {
  const all = driving();
  const { chip } = all.pico;
  for (let i = 0; i < 1e6 && chip.core.IPSR !== 0; ++i) all.pico.runFor(100);
  chip.core.waiting = false;
  chip.sramView.setUint16(kSpare - 0x20000000, 0xb5ff, true); // push everything, ...
  chip.sramView.setUint16(kSpare - 0x20000000 + 2, 0xe7fd, true); // ... for ever
  chip.core.PC = kSpare;
  const off_ms = offAfter_ms(all);
  print(`stack overflow: outputs off after ${off_ms.toFixed(0)} ms`);
  assert.ok(off_ms < 520);
  assert.equal(afterRestart(all).cause, cause.watchdog);
});

test('no tick comes between the stores that open the bridges', () => {
  const all = driving(), { chip } = all.pico;
  derail(all, 0, kForEver);
  chip.core.LR = kSpare | 1;
  chip.core.PC = symbols.get('_ZN5astro6rp20406Motors5coastEv');
  const { enable, bridge } = pins, forced = () => bridge.flat().filter((pin) => chip.gpio[pin].outputOverride === 2).length;
  let between = 0;
  for (let i = 0; i < 1000 && forced() < 4; ++i) {
    all.pico.runFor(8);
    if (chip.gpio[enable].outputValue || forced() === 4) continue;
    ++between;
    assert.ok(chip.core.PM, `an interrupt may come with ${forced()} of 4 pins low`);
  }
  assert.ok(between > 3);
});

test('a reboot and the boot loader open the bridges, and a reboot is no fault', () => {
  const { pico, host } = bench();
  host.hello();
  host.request(id.reboot);
  pico.runFor(1e9);
  assert.equal(pico.restarts, 1);
  host.hello();
  const status = host.status();
  assert.equal(status.cause, cause.software);
  assert.equal(status.faults, 0);
  assert.throws(() => { host.request(id.bootloader); for (let ms = 0; ms < 1000; ++ms) if (!host.advance(1)) throw new Error('loader'); }, /loader|no answer/);
  assert.equal(pico.chip.ended, 'loader');
  assert.deepEqual(pico.bridges(), open);
  expectNoComplaints(pico);
});

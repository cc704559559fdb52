import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { images, kImage } from './bench.mjs';

// The program of the host, as a process, against the emulated Pico, as another. Without it these tests have nothing to run.
const astrolabe = process.env.ASTRO_PROGRAM;
const here = dirname(fileURLToPath(import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'astrolabe-pico-'));
const drive = join(folder, 'RPI-RP2'), usbPort = join(folder, 'usb');
let server, port;

const run = (...words) => runAt(port, ...words);
function runAt(where, ...words) {
  const { status, stdout, stderr } = spawnSync(astrolabe, [...words, '--port', where], {
    encoding: 'utf8', timeout: 120e3, env: { ...process.env, ASTROLABE_PICO_DRIVE: drive },
  });
  return { status, text: stdout + stderr };
}

before(async () => {
  assert.ok(astrolabe, 'ASTRO_PROGRAM must name the program astrolabe');
  server = spawn('node', [join(here, 'rig/serve.mjs'), kImage, '--drive', drive, '--usb-pty', usbPort], { stdio: ['ignore', 'pipe', 'inherit'] });
  port = await new Promise((resolve, reject) => {
    server.stdout.on('data', (text) => { const found = /tcp:[0-9.]+:[0-9]+/.exec(text); if (found) resolve(found[0]); });
    server.on('exit', () => reject(new Error('the emulated Pico has ended')));
  });
  // It starts in the engine's slowest minute. In real time: faster, what the robot takes for its host's silence would depend on the
  // load of this computer.
  for (let tries = 0; tries < 10 && run('info').status !== 0; ++tries);
});
after(() => {
  server.kill();
  rmSync(folder, { recursive: true });
});

test('astrolabe finds a Pico, drives it and sets a parameter that outlives a restart', () => {
  const info = run('info');
  assert.equal(info.status, 0, info.text);
  assert.match(info.text, /board +rp2040/);
  const line = run('drive', 'line', '0.2');
  assert.equal(line.status, 0, line.text);
  assert.match(line.text, /x +0\.(19|20)\d\d m/);
  assert.equal(run('params', 'set', 'robot_name=PICO').status, 0);
  assert.equal(run('reboot').status, 0);
  assert.match(run('info').text, /name +PICO/);
});

test('flash copies the image to the drive that appears, and the parameters survive', () => {
  const flash = run('flash', kImage);
  assert.equal(flash.status, 0, flash.text);
  assert.match(flash.text, /for the board 'rp2040'/);
  assert.match(flash.text, /all \d+ parameters kept/);
  assert.match(run('info').text, /name +PICO/);
});

test('the same robot is at its USB port, where flash loads it as well', () => {
  const info = runAt(usbPort, 'info');
  assert.equal(info.status, 0, info.text);
  assert.match(info.text, /board +rp2040/);
  const line = runAt(usbPort, 'drive', 'line', '0.1');
  assert.match(line.text, /x +0\.(09|10)\d\d m/);
  const flash = runAt(usbPort, 'flash', kImage);
  assert.equal(flash.status, 0, flash.text);
  assert.match(flash.text, /all \d+ parameters kept/);
});

test('flash says how a Pico without firmware is loaded', () => {
  const { stderr } = spawnSync(astrolabe, ['flash', kImage, '--port', join(folder, 'none')], { encoding: 'utf8', timeout: 120e3 });
  assert.match(stderr, /flash with --button: hold BOOTSEL/);
});

test('images for another board, and damaged ones, are refused before anything is erased', () => {
  const image = readFileSync(kImage), damaged = join(folder, 'damaged.uf2');
  const refused = (bytes, reason) => {
    writeFileSync(damaged, bytes);
    const flash = run('flash', damaged);
    assert.notEqual(flash.status, 0);
    assert.match(flash.text, reason);
  };
  const changed = (at, value) => { const bytes = Buffer.from(image); bytes.writeUInt32LE(value, at); return bytes; };
  refused(changed(28, 0xada52840), /no image for an RP2040/); // the family of another maker's chip
  refused(changed(512 + 20, 7), /block 2 of/); // out of order
  refused(changed(512 + 12, 0x20000000), /no image for an RP2040/); // into SRAM
  refused(changed(40, 0), /check sum/); // the second stage
  refused(image.subarray(0, image.length - 100), /ends within a block/);
  refused(image.subarray(0, 512 * 20), /block 1 of/); // cut between blocks, each of which says how many there are
  const info = run('info');
  assert.match(info.text, /name +PICO/, 'the robot runs on');
});

test('an image for a Teensy is not for this robot', (context) => {
  const teensy = join(images, '../../teensy40/bin/astrolabe-teensy40.hex');
  if (!existsSync(teensy)) return context.skip(`there is no ${teensy}: ./dev firmware`);
  const loader = join(folder, 'loader');
  writeFileSync(loader, '#!/bin/sh\nexit 1\n', { mode: 0o755 });
  process.env.ASTROLABE_LOADER = loader;
  const flash = run('flash', teensy);
  delete process.env.ASTROLABE_LOADER;
  assert.notEqual(flash.status, 0);
  assert.match(flash.text, / is a 'rp2040' and '.*' is for a 'teensy40'/);
});

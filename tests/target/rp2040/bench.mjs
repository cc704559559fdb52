// What all tests of the Pico begin with: the image that is flashed, in a robot, with a host at its serial port.
import assert from 'node:assert/strict';
import { readUf2, symbolsOf } from './rig/image.mjs';
import { Host } from './rig/host.mjs';
import { Pico } from './rig/pico.mjs';
import { Robot } from './rig/robot.mjs';

export const images = process.env.ASTRO_IMAGE_DIR;
assert.ok(images, 'ASTRO_IMAGE_DIR must name the folder with the images (build/rp2040/bin)');
export const kImage = `${images}/astrolabe-rp2040.uf2`;
export const symbols = symbolsOf(`${images}/astrolabe-rp2040.elf`);

export function bench({ seed = 1, image = kImage } = {}) {
  const pico = new Pico({ seed, image: readUf2(image) });
  const robot = new Robot(pico);
  const host = new Host(pico, (ms) => robot.advance(ms));
  return { pico, robot, host };
}

// The firmware has done nothing that the chip forbids.
export function expectNoComplaints(pico) {
  assert.deepEqual([...pico.complaints, ...pico.chip.complaints], []);
}

export const open = ['coast', 'coast'];
export const print = (text) => process.stderr.write(`  ${text}\n`);

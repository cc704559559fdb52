// The files that a build leaves: a .uf2 as the boot loader would write it, and the addresses of a program's symbols.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';

const kBlock = 512, kFamily = 0xe48bff56;

export function readUf2(file) {
  const bytes = readFileSync(file);
  if (bytes.length === 0 || bytes.length % kBlock) throw new Error(`${file} does not consist of blocks of 512 bytes`);
  const count = bytes.length / kBlock, pieces = [];
  for (let i = 0; i < count; ++i) {
    const word = (at) => bytes.readUInt32LE(i * kBlock + at);
    const wanted = [0x0a324655, 0x9e5d5157, 0x2000, word(12), 256, i, count, kFamily];
    wanted.forEach((value, n) => {
      if (word(4 * n) !== value) throw new Error(`${file}, block ${i}: word ${n} is ${word(4 * n).toString(16)}`);
    });
    if (word(508) !== 0x0ab16f30) throw new Error(`${file}, block ${i} has no end`);
    const at = word(12) - 0x10000000;
    if (at % 256 || at < 0 || at + 256 > 2 << 20) throw new Error(`${file}, block ${i} lies outside the flash`);
    pieces.push({ at, bytes: bytes.subarray(i * kBlock + 32, i * kBlock + 288) });
  }
  return pieces;
}

export function symbolsOf(elf) {
  const symbols = new Map();
  for (const line of execFileSync('arm-none-eabi-nm', ['--defined-only', elf], { encoding: 'utf8', maxBuffer: 1 << 26 }).split('\n')) {
    const [address, , name] = line.split(' ');
    if (name) symbols.set(name, parseInt(address, 16));
  }
  return symbols;
}

// node puppet_server.mjs IMAGE SEED: the puppet image on an emulated Pico, moved by lines on the standard input, an answer for
// each. IMAGE.uf2 and IMAGE.elf are read. tests/target/rp2040/contract asks.
import { createInterface } from 'node:readline';
import { readUf2, symbolsOf } from './rig/image.mjs';
import { Pico } from './rig/pico.mjs';

const [image, seed] = process.argv.slice(2);
const symbols = symbolsOf(`${image}.elf`);
const ready = symbols.get('puppet_ready'), box = symbols.get('puppet_mailbox');
const kArgument = 4, kAnswer = 12, kBytes = 20; // the places in puppet.hpp's Mailbox
const pico = new Pico({ seed: Number(seed), image: readUf2(`${image}.uf2`) });
pico.flash.times = { erase: 100e3, program: 10e3 };

const ram = () => pico.chip.sram.subarray(box - 0x20000000 + kBytes);
const hex = (bytes) => Buffer.from(bytes).toString('hex') || '-';
const bytesOf = (text) => (text === '-' ? Buffer.alloc(0) : Buffer.from(text, 'hex'));

function start() {
  for (let us = 0; pico.word(ready) !== 1; us += 100) {
    if (us > 1e6) throw new Error('the puppet did not start');
    pico.runFor(100e3);
  }
}

// Time passes only in here, in `pass` and in `turn`. The wire waits, so that a host that does not read stays one.
function call(number, first, second, back, bytes) {
  ram().set(bytesOf(bytes));
  pico.setWord(box + kArgument, first);
  pico.setWord(box + kArgument + 4, second);
  pico.setWord(box, number);
  const restarts = pico.restarts;
  pico.chip.uart0.hold(true);
  for (let us = 0; pico.word(box) !== 0 && pico.restarts === restarts && us < 2e6; us += 10) if (!pico.runFor(10e3)) break;
  pico.chip.uart0.hold(false);
  if (pico.restarts !== restarts) return '0';
  const answer = BigInt(pico.word(box + kAnswer)) | (BigInt(pico.word(box + kAnswer + 4)) << 32n);
  return back ? `${answer} ${hex(ram().subarray(0, back))}` : `${answer}`;
}

const commands = {
  start: () => { start(); },
  call: (...words) => call(...words.slice(0, 4).map(Number), words[4]),
  pass: (ms) => { pico.runFor(Number(ms) * 1e6); },
  counts: (...counts) => { pico.setCounts(counts.map(Number)); },
  turn: (...counts) => { pico.turn(counts.map(Number)); },
  bridges: () => pico.bridges().join(' '),
  fault: (on) => { pico.setDriverFault(on === '1'); },
  send: (bytes) => { pico.chip.uart0.feed(bytesOf(bytes)); },
  receive: () => hex(pico.sent.splice(0)),
  loader: () => (pico.chip.ended === 'loader' ? '1' : '0'),
  restart: () => { pico.powerOn(); start(); },
  complaints: () => {
    const all = [...pico.complaints, ...pico.chip.complaints];
    for (const complaint of all) console.error(complaint);
    return `${all.length}`;
  },
};

for await (const line of createInterface({ input: process.stdin })) {
  const [command, ...words] = line.split(' ');
  try {
    console.log(`ok ${commands[command](...words) ?? ''}`);
  } catch (error) {
    console.log(`error ${error.message}`);
  }
}

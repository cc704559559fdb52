// node puppet_server.mjs IMAGE SEED: the puppet image on an emulated Pico, moved by lines on the standard input, an answer for
// each. IMAGE.uf2 and IMAGE.elf are read. tests/target/rp2040/contract asks.
import { createInterface } from 'node:readline';
import { readUf2, symbolsOf } from './rig/image.mjs';
import { Pico } from './rig/pico.mjs';
import { UsbHost } from './rig/usb_host.mjs';

const [image, seed] = process.argv.slice(2);
const symbols = symbolsOf(`${image}.elf`);
const ready = symbols.get('puppet_ready'), box = symbols.get('puppet_mailbox');
const kArgument = 4, kAnswer = 12, kBytes = 20; // the places in puppet.hpp's Mailbox
const pico = new Pico({ seed: Number(seed), image: readUf2(`${image}.uf2`) });
let usb = null; // a host at the USB port, if there is one
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

// Time passes only in here, in `pass` and in `turn`, and while a USB host connects. The wire waits, so that a host that does not read stays one.
function call(number, first, second, back, bytes) {
  ram().set(bytesOf(bytes));
  pico.setWord(box + kArgument, first);
  pico.setWord(box + kArgument + 4, second);
  pico.setWord(box, number);
  const restarts = pico.restarts;
  pico.chip.uart0.hold(true);
  if (usb) usb.reads = false;
  for (let us = 0; pico.word(box) !== 0 && pico.restarts === restarts && us < 2e6; us += 10) if (!pico.runFor(10e3)) break;
  pico.chip.uart0.hold(false);
  if (usb) usb.reads = true;
  if (pico.restarts !== restarts) return '0';
  const answer = BigInt(pico.word(box + kAnswer)) | (BigInt(pico.word(box + kAnswer + 4)) << 32n);
  return back ? `${answer} ${hex(ram().subarray(0, back))}` : `${answer}`;
}

// The board's ports by their numbers.
const wire = (port) => (port === '0' ? usb : pico.serial);

// The board comes to the bus once somebody has asked its port for bytes. While the host waits, the puppet's looks at its mailbox,
// which are most of what there is to emulate, are left out: the processor sleeps until the next interrupt or call.
function connect() {
  const kReadPort = 9;
  usb = new UsbHost(pico);
  usb.pass = (us) => {
    if (pico.chip.core.IPSR === 0 && !pico.chip.usb.pending) pico.chip.core.waiting = true;
    const runs = pico.runFor(us * 1000);
    pico.chip.core.waiting = false;
    return runs;
  };
  for (let tries = 0; tries < 100 && !usb.attached; ++tries) {
    usb.pass(10e3);
    call(kReadPort, 0, 0, 0, '-');
  }
  usb.connect();
}

const commands = {
  start: () => { start(); },
  connect: () => { connect(); },
  call: (...words) => call(...words.slice(0, 4).map(Number), words[4]),
  pass: (ms) => { if (usb) usb.pass(Number(ms) * 1000); else pico.runFor(Number(ms) * 1e6); },
  counts: (...counts) => { pico.setCounts(counts.map(Number)); },
  turn: (...counts) => { pico.turn(counts.map(Number)); },
  bridges: () => pico.bridges().join(' '),
  fault: (on) => { pico.setDriverFault(on === '1'); },
  send: (port, bytes) => { wire(port).feed(bytesOf(bytes)); },
  receive: (port) => hex(wire(port).takeReceived()),
  loader: () => (pico.chip.ended === 'loader' ? '1' : '0'),
  restart: () => { pico.powerOn(); start(); },
  complaints: () => {
    const all = [...pico.complaints, ...pico.chip.complaints, ...(usb?.errors ?? [])];
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

// node serve.mjs IMAGE.uf2 [--port N] [--pty PATH] [--usb-pty PATH] [--drive FOLDER] [--fast]: an emulated Pico in a robot, for the
// ordinary commands. Its serial port is at a TCP port of this machine, and at a pseudo terminal if --pty names a path for one (by
// socat); its USB port at that of --usb-pty, with a host between that always has it open. While it is in its boot loader FOLDER is its drive: a .uf2 that is copied there is loaded and started. In real time unless
// --fast. Prints where it listens, and runs until it is ended.
import { spawn } from 'node:child_process';
import { constants, existsSync, mkdirSync, openSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { readUf2 } from './image.mjs';
import { Pico } from './pico.mjs';
import { Robot } from './robot.mjs';
import { UsbHost } from './usb_host.mjs';

const kUsage = 'node serve.mjs IMAGE.uf2 [--port N] [--pty PATH] [--usb-pty PATH] [--drive FOLDER] [--fast]';

function fail(text) {
  console.error(`serve.mjs: ${text}`);
  process.exit(1);
}

function options() {
  try {
    const { values, positionals } = parseArgs({
      allowPositionals: true,
      options: { port: { type: 'string', default: '0' }, pty: { type: 'string' }, 'usb-pty': { type: 'string' }, drive: { type: 'string' }, fast: { type: 'boolean', default: false } },
    });
    if (positionals.length !== 1) fail(`name one image: ${kUsage}`);
    if (!/^[0-9]{1,5}$/.test(values.port) || Number(values.port) > 65535) fail(`--port ${values.port} is no port: 0 to 65535`);
    return { ...values, image: positionals[0] };
  } catch (error) {
    return fail(`${error.message}: ${kUsage}`);
  }
}

const { port, pty, 'usb-pty': usbPty, drive, fast, image } = options();
if (pty && pty === usbPty) fail('--usb-pty must be another path than --pty');
let pico;
try {
  pico = new Pico({ image: readUf2(image) });
} catch (error) {
  fail(error.message);
}
const robot = new Robot(pico);
const usb = usbPty ? new UsbHost(pico) : null;
const outlets = new Set(), usbOutlets = new Set(); // what the robot sends at a port goes to all of the port's

const server = createServer((socket) => {
  outlets.add(socket);
  socket.setNoDelay(true);
  socket.on('data', (bytes) => pico.serial.feed(bytes));
  socket.on('error', () => socket.destroy());
  socket.on('close', () => outlets.delete(socket));
});
server.on('error', (error) => fail(`cannot listen at port ${port}: ${error.message}`));
server.listen(Number(port), '127.0.0.1', () => console.log(`listening on tcp:127.0.0.1:${server.address().port}`));

function openPty(path, wire, to) {
  if (existsSync(path)) fail(`there is something at '${path}' already: name another path`);
  const socat = spawn('socat', ['-', `pty,raw,echo=0,mode=600,link=${path}`], { stdio: ['pipe', 'pipe', 'inherit'] });
  socat.on('error', (error) => fail(`socat makes the pseudo terminal and cannot be run (${error.code}): apt install socat`));
  socat.on('exit', () => fail('socat has ended, and the pseudo terminal with it'));
  socat.stdout.on('data', (bytes) => wire.feed(bytes));
  socat.stdin.on('error', () => {});
  to.add(socat.stdin);
  // Open here all the time, so that it stays when a program closes it.
  const appears = setInterval(() => {
    if (!existsSync(path)) return;
    clearInterval(appears);
    openSync(path, constants.O_RDWR | constants.O_NOCTTY);
    console.log(`listening on ${path}`);
  }, 20);
}
if (pty) openPty(pty, pico.serial, outlets);
if (usbPty) openPty(usbPty, usb, usbOutlets);

// The drive of the boot loader.
function serveDrive() {
  if (!existsSync(drive)) {
    mkdirSync(drive, { recursive: true });
    writeFileSync(join(drive, 'INFO_UF2.TXT'), 'UF2 Bootloader v3.0\nModel: Raspberry Pi RP2\nBoard-ID: RPI-RP2\n');
    console.log(`in its boot loader (${pico.chip.loaderReason}): its drive is ${drive}`);
  }
  for (const name of readdirSync(drive).filter((file) => file.endsWith('.uf2'))) {
    let pieces;
    try {
      pieces = readUf2(join(drive, name));
    } catch {
      return; // not complete yet; what never becomes so is ignored, as the boot loader does
    }
    for (const { at, bytes } of pieces) {
      if (at % 4096 === 0) pico.flash.erase(at, 4096);
      pico.flash.load(at, bytes);
    }
    rmSync(drive, { recursive: true });
    pico.restart();
    console.log('loaded a new program');
  }
}

function pass(wire, to) {
  const bytes = Buffer.from(wire.takeReceived());
  if (bytes.length) for (const outlet of to) outlet.write(bytes);
}

let said = 0;
let begun = performance.now(), begun_ns = 0;
function run() {
  const until = performance.now() + 20;
  while (performance.now() < until) {
    if (!fast && (pico.now_ns - begun_ns) / 1e6 > performance.now() - begun) break;
    if (!robot.advance(1)) {
      if (!drive) {
        console.log(`in its boot loader: ${pico.chip.loaderReason}`);
        process.exit(0);
      }
      serveDrive();
      begun = performance.now();
      begun_ns = pico.now_ns;
      break;
    }
    pass(pico.serial, outlets);
    if (usb) {
      if (usb.attached && !usb.open) usb.connect();
      pass(usb, usbOutlets);
    }
  }
  const complaints = [...pico.complaints, ...pico.chip.complaints, ...(usb?.errors ?? [])];
  for (; said < complaints.length; ++said) console.error(`the firmware did what it must not: ${complaints[said]}`);
  if (fast) setImmediate(run);
  else setTimeout(run, 1);
}
run();

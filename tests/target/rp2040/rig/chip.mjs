// The chip: rp2040js, with what it lacks put beside it, and strict where it is lenient. What the firmware must not do is
// collected in `complaints`, which a test expects to be empty.
import { RP2040 } from 'rp2040js';
import { BootRom } from './boot_rom.mjs';
import { FlashController } from './flash_controller.mjs';
import { Words } from './registers.mjs';
import { Uart } from './uart.mjs';
import { UsbController } from './usb_controller.mjs';

const kUsbMemory = 0x50100000, kUsbMemoryEnd = 0x50101000;
const kFlash = 0x10000000, kFlashEnd = 0x14000000, kRam = 0x20000000, kRamEnd = 0x20042000;
const kHardFault = 3;

// Bits of RESETS by the upper part of the address.
const kInReset = new Map([
  [0x4004c, 0], [0x40014, 5], [0x40018, 6], [0x4001c, 8], [0x40020, 9], [0x50200, 10], [0x50300, 11], [0x40028, 12],
  [0x4002c, 13], [0x40050, 14], [0x40004, 18], [0x40054, 21], [0x40034, 22], [0x40038, 23], [0x50100, 24], [0x50110, 24],
]);
const kOutOfReset = (1 << 6) | (1 << 9) | (1 << 18); // what the boot ROM needs

const quiet = { debug() {}, info() {}, warn() {}, error() {} };

export class Chip extends RP2040 {
  constructor(flash, { reason = 0, scratch = new Uint32Array(8), chipReset = 1 << 8, watchdogRuns = false } = {}) {
    super();
    this.flashPart = flash;
    this.complaints = [];
    this.ended = null; // 'watchdog', 'loader', 'lock-up', or 'cut' by a test
    this.instructions = 0;
    this.extraCycles = 0;
    this.cache = new Int32Array(2048).fill(-1); // of the mapping: 16 KB in lines of eight bytes
    this.faulted = false;
    this.resetWord = 0x01ffffff & ~kOutOfReset;
    this.clkSys = this.clkPeri = 6.5e6; // the ring oscillator
    this.core.VTOR = 0;
    this.logger = { ...quiet, warn: (name, text) => this.heard(name, text), error: (name, text) => this.heard(name, text) };
    this.controller = new FlashController(this);
    this.uart0 = new Uart(this);
    this.usb = new UsbController(this);
    this.watchdog = this.peripherals[0x40058];
    this.watchdog.reason = reason;
    this.watchdog.tickEnable = false;
    this.watchdog.scratchData.set(scratch);
    this.requireStoppedWatchdog(watchdogRuns);
    this.watchdog.onWatchdogTrigger = () => this.watchdogTriggered();
    this.psm = new Words(this, 'PSM');
    Object.assign(this.peripherals, {
      0x18000: this.controller.ssi,
      0x40018: this.controller.pins,
      0x40034: this.uart0.words,
      0x50110: this.usb.words,
      0x40010: this.psm,
      0x40064: new Words(this, 'CHIP_RESET', { initial: { 8: chipReset } }),
      0x4000c: new Words(this, 'RESETS', {
        initial: { 0: this.resetWord },
        reads: { 8: () => ~this.resetWord & 0x01ffffff },
        writes: { 0: (value) => { this.resetWord = value; if (!this.usb.awake) this.usb.reset(); } },
      }),
    });
    this.stepPio();
    this.requireTick();
    this.rom = new BootRom(this);
    this.onBreak = (number) => this.broke(number);
    this.rom.start();
  }

  complain(text) {
    if (this.complaints.length < 20) this.complaints.push(`${text} (at 0x${this.lastPc?.toString(16)}, ${(this.clock.nanos / 1e6).toFixed(3)} ms)`);
  }

  // What the engine warns of: an address where nothing is, which on the chip is a fault; an instruction that it does not know.
  heard(name, text) {
    if (/invalid memory|undefined address|not implemented yet/.test(text)) this.faulted = true;
    else this.complain(`${name}: ${text}`);
  }

  findPeripheral(address) {
    const key = (address >>> 14) << 2;
    const bit = kInReset.get(key);
    if (bit !== undefined && this.resetWord & (1 << bit)) return this.asleep;
    return this.peripherals[key];
  }

  asleep = { readUint32: () => 0, writeUint32Atomic: () => {} };

  // Memory. The mapped flash answers only while it is mapped and not busy, and takes its time.
  flashWord(address) {
    if (!this.controller.mapped) { this.complain(`read of the flash at 0x${address.toString(16)} while it is not mapped`); return 0xffffffff; }
    if (this.rom.running) { this.complain('read of the flash while it is busy'); return 0xffffffff; }
    const bytes = this.flashPart.bytes, at = address & 0xffffff, line = at >>> 3;
    if (address >= 0x11000000) this.extraCycles += this.controller.readCycles;
    else if (this.cache[line & 2047] !== line) {
      this.cache[line & 2047] = line;
      this.extraCycles += 2 * this.controller.readCycles;
    }
    if (at + 3 >= bytes.length) return 0xffffffff;
    return (bytes[at] | (bytes[at + 1] << 8) | (bytes[at + 2] << 16) | (bytes[at + 3] << 24)) >>> 0;
  }

  readUint32(address) {
    address = address >>> 0;
    if (address & 3) this.faulted = true;
    if (address >= kRam && address < kRamEnd - 3) return this.sramView.getUint32(address - kRam, true);
    if (address >= kFlash && address < kFlashEnd) return this.flashWord(address);
    if (address >= kUsbMemory && address < kUsbMemoryEnd) return this.usb.awake ? this.usb.readMemory(address - kUsbMemory) : 0;
    return super.readUint32(address);
  }
  readUint16(address) {
    address = address >>> 0;
    if (address & 1) this.faulted = true;
    if (address >= kRam && address < kRamEnd - 1) return this.sramView.getUint16(address - kRam, true);
    const word = this.readUint32((address & ~3) >>> 0);
    return address & 2 ? word >>> 16 : word & 0xffff;
  }
  readUint8(address) {
    address = address >>> 0;
    if (address >= kRam && address < kRamEnd) return this.sram[address - kRam];
    return (this.readUint32((address & ~3) >>> 0) >>> (8 * (address & 3))) & 0xff;
  }
  writeUint32(address, value) {
    address = address >>> 0;
    if (address & 3) this.faulted = true;
    if (address >= kRam && address < kRamEnd - 3) return this.sramView.setUint32(address - kRam, value, true);
    if (address < 0x4000 || (address >= kFlash && address < kFlashEnd)) { this.faulted = true; return; }
    if (address >= kUsbMemory && address < kUsbMemoryEnd) { if (this.usb.awake) this.usb.writeMemory(address - kUsbMemory, value); return; }
    super.writeUint32(address, value);
  }
  writeUint16(address, value) {
    if (address & 1) this.faulted = true;
    super.writeUint16(address >>> 0, value);
  }

  broke(number) {
    const at = this.core.PC - 2;
    if (at < 0x4000) this.rom.called(number);
    else this.faulted = true;
  }

  // The state machines run whenever somebody looks at them or a pin changes, up to that moment: a clock each.
  stepPio() {
    const pio = this.pio[0];
    pio.run = () => {};
    let reached = 0;
    this.syncPio = () => {
      const now = Math.round(this.clock.nanos / 8);
      const steps = Math.min(now - reached, 160); // then it has settled: the queue is full, and nothing has moved
      reached = now;
      for (const machine of pio.machines) if (machine.enabled) for (let i = 0; i < steps; ++i) machine.step();
    };
    const read = pio.readUint32.bind(pio), write = pio.writeUint32.bind(pio);
    pio.readUint32 = (offset) => { this.syncPio(); return read(offset); };
    pio.writeUint32 = (offset, value) => { this.syncPio(); return write(offset, value); };
  }

  // The engine's timer runs without the tick that the watchdog makes of the crystal.
  requireTick() {
    const timer = this.peripherals[0x40054], read = timer.readUint32.bind(timer);
    timer.readUint32 = (offset) => {
      if (!this.watchdog.tickEnable) this.complain('the timer is read while it has no tick');
      return read(offset);
    };
  }

  // A restart by the watchdog does not reset it. What its timer does after its end is not known, so the firmware must stop it.
  requireStoppedWatchdog(runs) {
    const { watchdog } = this, write = watchdog.writeUint32.bind(watchdog);
    watchdog.writeUint32 = (offset, value) => {
      if (offset === 0 && !(value & (1 << 31))) {
        if (runs && value & (1 << 30)) this.complain('the watchdog is started before it was stopped');
        runs = false;
      }
      write(offset, value);
    };
  }

  setPin(number, level) {
    this.syncPio();
    this.gpio[number].setInputValue(level);
  }

  watchdogTriggered() {
    if (this.psm.at(8) !== 0x1fffc) this.complain('the watchdog restarts without the peripherals (PSM.WDSEL)');
    this.watchdog.alarm.enable = false;
    this.ended = 'watchdog';
  }
  enterLoader(why) {
    if (this.watchdog.enable) this.complain('the watchdog runs on in the boot loader, where nobody feeds it');
    this.loaderReason = why;
    this.ended = 'loader';
  }

  fault(pc) {
    this.faulted = false;
    if (this.core.IPSR === kHardFault) { this.ended = 'lock-up'; return; }
    this.core.PC = pc;
    this.core.exceptionEntry(kHardFault);
  }

  // Until `nanos` of the chip's clock, or until it has ended; a locked-up core waits for its watchdog.
  runUntil(nanos) {
    const { core, clock } = this;
    while (clock.nanos < nanos && (this.ended === null || this.ended === 'lock-up')) {
      if (core.waiting || this.ended === 'lock-up') {
        const next = clock.nextAlarm ? Math.min(clock.nextAlarm.nanos, nanos) : nanos;
        clock.tick(Math.max(next - clock.nanos, 0));
        continue;
      }
      const pc = core.PC;
      this.lastPc = pc;
      const cycles = core.executeInstruction() + this.extraCycles;
      this.extraCycles = 0;
      ++this.instructions;
      clock.tick((cycles * 1e9) / this.clkSys);
      if (this.faulted) this.fault(pc);
    }
  }
}

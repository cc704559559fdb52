// What the boot ROM does, without its code: the check of the second stage, and the functions that the firmware calls. Each
// function is a `bkpt` in the ROM's memory that the engine reports.
import { kPageBytes, kSectorBytes } from './flash.mjs';

const kTable = 0x0100, kFirst = 0x0200, kBytesEach = 4;
const kNames = ['lookup', 'IF', 'EX', 'RE', 'RP', 'FC', 'CX', 'UB'];
const kStageAt = 0x20041f00;

export function checkSum(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes)
    for (let bit = 7; bit >= 0; --bit) {
      const out = (sum >>> 31) ^ ((byte >>> bit) & 1);
      sum = (sum << 1) >>> 0;
      if (out) sum = (sum ^ 0x04c11db7) >>> 0;
    }
  return sum;
}

export class BootRom {
  constructor(chip) {
    this.chip = chip;
    this.running = null; // the operation of the flash that is under way
    kNames.forEach((name, i) => { chip.bootrom[(kFirst + kBytesEach * i) / 4] = 0x47700000 | 0xbe00 | i; }); // bkpt i; bx lr
    chip.bootrom[0x14 / 4] = kTable;
    chip.bootrom[0x18 / 4] = kFirst | 1;
  }

  // From the reset to the second stage. A chip without a valid one waits in the loader.
  start() {
    const { chip } = this;
    const stage = chip.flashPart.bytes.subarray(0, kPageBytes);
    const wanted = new DataView(stage.buffer, stage.byteOffset + 252, 4).getUint32(0, true);
    if (checkSum(stage.subarray(0, 252)) !== wanted) return chip.enterLoader('the second stage has a wrong check sum');
    chip.sram.set(stage, kStageAt - 0x20000000);
    chip.controller.ssi.words.set(0x08, 0); // unmapped until the second stage has run
    chip.core.SP = 0x20042000;
    chip.core.LR = 0;
    chip.core.PC = kStageAt;
  }

  called(number) {
    const { core, controller } = this.chip;
    const [first, second, third] = core.registers;
    switch (kNames[number]) {
      case 'lookup': {
        const name = String.fromCharCode(second & 0xff, (second >>> 8) & 0xff);
        const found = first === kTable ? kNames.indexOf(name) : -1;
        core.registers[0] = found > 0 ? (kFirst + kBytesEach * found) | 1 : 0;
        break;
      }
      case 'IF': this.connected = true; break;
      case 'EX':
        if (!this.connected) this.chip.complain('flash_exit_xip before connect_internal_flash');
        controller.serial();
        break;
      case 'RE': return this.write({ at: first, size: second, bytes: null });
      case 'RP': return this.write({ at: first, size: third, bytes: this.chip.sram.slice(second - 0x20000000, second - 0x20000000 + third) });
      case 'FC': controller.releaseSelect(); break;
      case 'CX': controller.map(); break;
      case 'UB': return this.chip.enterLoader('the firmware asked for it');
    }
  }

  // Stands on its own instruction until the flash has done it, so that interrupts are served meanwhile.
  write(operation) {
    const { chip } = this;
    if (!this.running) {
      const unit = operation.bytes ? kPageBytes : kSectorBytes;
      if (operation.at % unit || operation.size % unit || operation.size === 0) chip.complain(`the flash was told to write ${operation.size} bytes at ${operation.at}`);
      if (chip.controller.mapped) chip.complain('the flash was written while it is mapped');
      const time = operation.bytes ? chip.flashPart.times.program : chip.flashPart.times.erase;
      this.running = { ...operation, until: chip.clock.nanos + (time * operation.size) / unit, done: false };
      const alarm = chip.clock.createAlarm(() => { this.running.done = true; chip.core.waiting = false; });
      alarm.schedule(this.running.until - chip.clock.nanos);
      chip.onFlashOperation?.(this.running);
    }
    if (this.running.done) {
      if (this.running.bytes) chip.flashPart.program(this.running.at, this.running.bytes);
      else chip.flashPart.erase(this.running.at, this.running.size);
      this.running = null;
      return;
    }
    chip.core.PC -= 2;
    chip.core.waiting = true;
  }
}

// A Pico: a flash that stays, a chip that starts anew after each restart, and the pins at which a robot hangs.
import { Chip } from './chip.mjs';
import { Flash } from './flash.mjs';

const kPor = 1 << 8;
const kPwmPeriod = 6250;
export const pins = { left: 2, right: 4, bridge: [[6, 7], [8, 9]], enable: 10, driverError: 11, led: 25 };

export class Pico {
  constructor({ seed = 1, image = null } = {}) {
    this.flash = new Flash(seed);
    if (image) for (const { at, bytes } of image) this.flash.load(at, bytes);
    this.counts = [0, 0]; // edges of each shaft
    this.driverFault = false;
    this.supply_mV = 12000;
    this.restarts = 0;
    this.before_ns = 0; // the time of the chips before this one
    this.complaints = [];
    this.sent = []; // by the serial port
    this.serial = { feed: (bytes) => this.chip.uart0.feed(bytes), takeReceived: () => this.sent.splice(0) };
    this.onStart = () => {};
    this.powerOn();
  }

  get now_ns() {
    return this.before_ns + this.chip.clock.nanos;
  }

  powerOn() {
    this.start(new Chip(this.flash, { chipReset: kPor }));
  }
  start(chip) {
    if (this.chip) {
      this.before_ns += this.chip.clock.nanos;
      this.complaints.push(...this.chip.complaints);
    }
    this.chip = chip;
    chip.uart0.onByte = (byte) => this.sent.push(byte);
    this.showShafts();
    this.setDriverFault(this.driverFault);
    this.setSupply(this.supply_mV);
    this.onStart(chip);
  }

  // Ends the supply: what the flash was doing stays half done.
  cutPower() {
    if (this.chip.rom.running) this.flash.tear(this.chip.rom.running);
  }

  // The chip's time and all restarts; false once it is in its loader.
  runFor(nanos) {
    const end = this.now_ns + nanos;
    while (this.now_ns < end) {
      this.chip.runUntil(end - this.before_ns);
      if (this.chip.ended === 'loader' || this.chip.ended === 'cut') return false;
      if (this.chip.ended === 'watchdog') this.restart();
    }
    return true;
  }
  restart() {
    ++this.restarts;
    const { reason, scratchData, enable } = this.chip.watchdog;
    this.start(new Chip(this.flash, { reason, scratch: scratchData, chipReset: kPor, watchdogRuns: enable }));
  }

  word(address) {
    return this.chip.sramView.getUint32(address - 0x20000000, true);
  }
  setWord(address, value) {
    this.chip.sramView.setUint32(address - 0x20000000, value, true);
  }

  // One edge of a shaft. A leads B forward.
  showShafts() {
    [pins.left, pins.right].forEach((first, side) => {
      const phase = this.counts[side] & 3;
      this.chip.setPin(first, phase === 1 || phase === 2);
      this.chip.setPin(first + 1, phase === 2 || phase === 3);
    });
  }
  step(side, direction) {
    this.counts[side] = (this.counts[side] + direction) | 0;
    const first = side === 0 ? pins.left : pins.right, phase = this.counts[side] & 3;
    this.chip.setPin(first, phase === 1 || phase === 2);
    this.chip.setPin(first + 1, phase === 2 || phase === 3);
  }
  // Both shafts turn, an edge a microsecond.
  turn(counts) {
    const left = [...counts];
    while (left[0] !== 0 || left[1] !== 0) {
      for (const side of [0, 1])
        if (left[side] !== 0) {
          const direction = Math.sign(left[side]);
          this.step(side, direction);
          left[side] -= direction;
        }
      this.runFor(1000);
    }
  }
  // What the decoders have counted so far, as if they had been turning for long.
  setCounts(counts) {
    this.chip.syncPio();
    counts.forEach((count, side) => {
      const machine = this.chip.pio[0].machines[side];
      machine.x = count >>> 0;
    });
    this.runFor(2000);
  }

  setDriverFault(fault) {
    this.driverFault = fault;
    this.chip.setPin(pins.driverError, !fault);
  }
  setSupply(mV) {
    this.supply_mV = mV;
    this.chip.adc.channelValues[0] = Math.min(4095, Math.round(((mV / 9.2) * 4095) / 3300));
  }

  // What each motor feels: 'coast', 'brake' or a duty from -1 to 1, as the pins are and the PWM runs.
  bridges() {
    const { chip } = this;
    const enabled = this.drives(pins.enable) && chip.gpio[pins.enable].outputValue;
    return pins.bridge.map(([in1, in2], side) => {
      const high = [in1, in2].map((pin, i) => this.highShare(pin, 3 + side, i));
      if (!enabled || (high[0] === 0 && high[1] === 0)) return 'coast';
      // Both count from the beginning of a period, so the shorter one lies within the longer one.
      if (high[0] === 1 && high[1] === 1) return 'brake';
      if (Math.max(...high) < 1) return 'mixed';
      return high[0] - high[1];
    });
  }
  drives(pin) {
    return this.chip.gpio[pin].outputEnable && !(this.chip.resetWord & (1 << 5));
  }
  highShare(pin, slice, output) {
    const { gpio, pwm } = this.chip;
    if (!this.drives(pin)) return 0; // its pull-down
    const override = gpio[pin].outputOverride;
    if (override >= 2) return override - 2;
    if (gpio[pin].functionSelect !== 4) return gpio[pin].outputValue ? 1 : 0;
    const channel = pwm.channels[slice];
    if (!(channel.csr & 1) || channel.timer.top !== kPwmPeriod - 1) return NaN;
    const target = output === 0 ? channel.alarmA.target : channel.alarmB.target;
    return Math.min(target, kPwmPeriod) / kPwmPeriod;
  }
}

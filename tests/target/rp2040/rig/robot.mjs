// Motors and wheels around a Pico: each wheel follows the duty of its bridge with a time constant, and its encoder makes
// edges. As the reference robot's: 12,000 counts a second at 12 V, 50 ms.
const kCountsPerMs = 12, kDriven_ms = 50, kCoasting_ms = 150, kSlice_ns = 250e3;

export class Robot {
  constructor(pico) {
    this.pico = pico;
    this.speeds = [0, 0]; // counts a millisecond
    this.travel = [0, 0]; // counts, with their fractions
  }

  advance(ms) {
    for (let slice = 0; slice < (ms * 1e6) / kSlice_ns; ++slice) if (!this.slice()) return false;
    return true;
  }

  slice() {
    const bridges = this.pico.bridges(), edges = [];
    bridges.forEach((bridge, side) => {
      const wanted = typeof bridge === 'number' ? (bridge * kCountsPerMs * this.pico.supply_mV) / 12000 : 0;
      const slice_ms = kSlice_ns / 1e6;
      this.speeds[side] += (wanted - this.speeds[side]) * (slice_ms / (bridge === 'coast' ? kCoasting_ms : kDriven_ms));
      const before = Math.floor(this.travel[side]);
      this.travel[side] += this.speeds[side] * slice_ms;
      const count = Math.floor(this.travel[side]) - before;
      for (let i = 0; i < Math.abs(count); ++i) edges.push([((i + 0.5) / Math.abs(count)) * kSlice_ns, side, Math.sign(count)]);
    });
    edges.sort((a, b) => a[0] - b[0]);
    const begun = this.pico.now_ns;
    for (const [at, side, direction] of edges) {
      if (!this.pico.runFor(Math.max(begun + at - this.pico.now_ns, 0))) return false;
      this.pico.step(side, direction);
    }
    return this.pico.runFor(Math.max(begun + kSlice_ns - this.pico.now_ns, 0));
  }
}

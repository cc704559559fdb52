/** The robot drives on for at most 250 ms after a velocity, so one that is lost or late does not make it stutter. */
const kEvery_ms = 80;

export interface Velocity {
  v_mps: number;
  w_radps: number;
}

/**
 * A velocity that somebody holds: it is sent again and again until it is let go, and the robot rests as soon as nothing comes. Only
 * one is under way at a time, so that a slow link never keeps older ones that would be driven later.
 */
export class HeldDrive {
  private held: Velocity | null = null;
  private timer = 0;
  private under_way = false;

  /**
   * `send`    has the robot drive; a rejection lets go
   * `refused` is told why it was rejected
   */
  constructor(
    private send: (velocity: Velocity) => Promise<unknown>,
    private refused: (why: unknown) => void,
  ) {}

  get holds() {
    return this.held !== null;
  }

  hold(velocity: Velocity) {
    const begins = this.held === null;
    this.held = velocity;
    if (!begins) return;
    this.step();
    this.timer = window.setInterval(() => this.step(), kEvery_ms);
  }

  /** The robot comes to rest at once. */
  release() {
    if (!this.drop()) return;
    this.send({ v_mps: 0, w_radps: 0 }).catch(this.refused);
  }

  /** Sends nothing more; answers whether anything was held. */
  drop(): boolean {
    const held = this.holds;
    this.held = null;
    clearInterval(this.timer);
    return held;
  }

  private step() {
    if (!this.held || this.under_way) return;
    this.under_way = true;
    this.send(this.held)
      .catch((why: unknown) => {
        this.drop();
        this.refused(why);
      })
      .finally(() => (this.under_way = false));
  }
}

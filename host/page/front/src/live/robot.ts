import { type Backend, type Event_, Refusal, sentence_of } from "../backend";
import { save } from "../saving";
import type { Opened, Parameter, PathEvent, Poses, RobotState, Samples } from "./contract";
import { Frames } from "./frames";
import { HeldDrive } from "./held_drive";
import { SampleRing } from "./sample_ring";
import { Trail } from "./trail";

/** A minute at 1 kHz. */
const kSamples = 60_000;
/** A state comes once a second, so after this time the robot or whoever reaches it is gone. */
const kSilence_ms = 2500;
const kLookAgain_ms = 1000;
/** What is always watched, because it is always shown. */
export const kWheelSignals = ["speed", "setpoint", "duty"].flatMap((what) => ["left", "right"].map((side) => `${side}_${what}`));

/** The robot that is open, as the page knows it. Nothing of it is drawn here. */
export class Robot {
  opened: Opened | null = null;
  parameters: Parameter[] = [];
  state: RobotState | null = null;
  /** Recordings that have ended and that nobody has removed, also of a robot that is closed. */
  recordings: string[] = [];
  /** Those of them, or of an earlier page, that the browser got: it does not say whether it has saved them. */
  given: ReadonlySet<string> = new Set();
  /** Why nothing is heard of an open robot; "" if it is heard. */
  lost = "";
  /** The last command that could not be carried out, or a remark of a drive. */
  refusal: unknown = null;
  /** This page has armed the robot, but it was stopped since, and moves for nobody until it is armed again. */
  halted = false;
  /** How often nobody was looking any more: a step of several questions compares it before the robot moves. */
  left = 0;
  /** The part of a path that is driven; null if none is. */
  path_done: number | null = null;
  readonly samples = new SampleRing(kSamples);
  readonly latest = new Map<string, number>();
  odometry = new Trail();
  truth = new Trail();
  readonly frames = new Frames();
  readonly drive: HeldDrive;
  private question: unknown = null;
  private heard_ms = 0;
  private listeners = new Set<() => void>();
  private opening = false;
  /** Questions under way that make the robot drive, of which the state may say nothing yet. */
  private driving_asked = 0;

  constructor(readonly backend: Backend) {
    backend.listen((event) => this.take(event));
    this.drive = new HeldDrive((velocity) => backend.ask("robot/drive", velocity), (why) => {
      this.halted = true;
      this.refuse(why);
    });
    setInterval(() => this.look(), kLookAgain_ms);
  }

  subscribe(told: () => void): () => void {
    this.listeners.add(told);
    return () => this.listeners.delete(told);
  }

  async open(question: unknown) {
    this.opening = true;
    try {
      await this.enter(question);
    } finally {
      this.opening = false;
    }
    this.odometry = new Trail();
    this.truth = new Trail();
    this.samples.clear();
    this.changed();
  }

  async close() {
    this.drive.drop();
    if (await this.command("robot/close")) this.forget();
  }

  /** Opens the robot that whoever answers has open already; false if it has none. */
  async open_present(): Promise<boolean> {
    try {
      await this.open({});
      return true;
    } catch {
      return false;
    }
  }

  /** Asks for these signals, besides those of the wheels. */
  async watch(signals: string[], rate_hz: number) {
    this.samples.watch(signals);
    await this.backend.ask("robot/watch", { signals: [...new Set([...signals, ...kWheelSignals])], rate_hz });
  }

  /** This page has armed the robot. */
  get is_mine() {
    return this.lost === "" && this.state !== null && this.state.armed && this.state.driver === this.opened?.page;
  }

  /** The robot drives for this page. */
  get drives() {
    return this.is_mine && !this.halted;
  }

  async arm() {
    if (await this.command("robot/arm")) this.halted = false;
    this.changed();
  }

  /** Has the robot do something; what it refuses is shown. */
  async command(call: string, question: object = {}): Promise<boolean> {
    try {
      await this.backend.ask(call, question);
      this.refuse(null);
      return true;
    } catch (error) {
      this.refuse(error);
      return false;
    }
  }

  /** Zero duty at once. */
  async emergency_stop() {
    this.drive.drop();
    if (await this.command("robot/emergency_stop")) return;
    this.refuse(new Refusal(`The emergency stop is not confirmed: ${sentence_of(this.refusal)}. If the robot moves, switch its supply off.`));
  }

  /** Ramps to rest. */
  async stop() {
    this.drive.drop();
    this.halted = true;
    this.changed();
    await this.command("robot/stop");
  }

  refuse(why: unknown) {
    if (this.refusal === why) return;
    this.refusal = why;
    this.changed();
  }

  /** It stays where it is, because a person may leave the browser's dialog without saving. */
  async save_recording(file: string) {
    this.give(file, await this.backend.file(file));
  }

  give(name: string, content: Blob) {
    save(name, content);
    this.given = new Set([...this.given, name]);
    this.changed();
  }

  /** Another recording may get its name. */
  was_removed(name: string) {
    this.given = new Set([...this.given].filter((each) => each !== name));
    this.changed();
  }

  /** A person has it, or does not want it. */
  async remove_recording(file: string) {
    await this.backend.ask("robot/remove_recording", { file });
    this.was_removed(file);
  }

  async read_parameters() {
    this.parameters = (await this.backend.ask<{ parameters: Parameter[] }>("robot/parameters", {})).parameters;
    this.changed();
  }

  /** Whoever held the robot may not see any more that it drives. */
  abandon() {
    if (this.drive.holds) void this.stop();
  }

  /** Nobody may be looking any more, or a question is open: a robot that is armed for this page is stopped. */
  leave_alone() {
    this.left++;
    if (this.is_mine || this.driving_asked > 0) void this.stop();
  }

  /** Asks what makes the robot drive; leave_alone() stops it from now on. */
  async ask_to_drive<Answer>(call: string, question: object): Promise<Answer> {
    this.driving_asked++;
    try {
      return await this.backend.ask<Answer>(call, question);
    } finally {
      this.driving_asked--;
    }
  }

  private async enter(question: unknown) {
    const opened = await this.backend.ask<Opened>("robot/open", question);
    this.question = opened.simulated ? question : { port: opened.port };
    this.opened = opened;
    this.parameters = opened.parameters;
    this.heard_ms = performance.now();
    this.lost = "";
    this.path_done = null;
  }

  private take(event: Event_) {
    if (event.event === "connection") {
      this.drive.drop();
      this.state = null;
      this.lose(event.up ? "" : `${event.why}.`);
      if (event.up) void this.come_back();
      return;
    }
    if (event.event === "state") this.take_recordings((event as RobotState).recordings);
    if (!this.opened) {
      // Another page has opened it.
      if (event.event === "state" && event.open && !this.opening) void this.open_present();
      return;
    }
    this.heard_ms = performance.now();
    if (event.event === "samples") this.take_samples(event as Samples);
    else if (event.event === "pose") this.take_pose(event as Poses);
    else if (event.event === "path") this.take_path(event as PathEvent);
    else if (event.event === "notice") this.refuse(new Refusal(event.sentence as string));
    else if (event.event === "state") this.take_state(event as RobotState);
  }

  private take_recordings(recordings: string[]) {
    if (recordings.join("/") === this.recordings.join("/")) return;
    this.recordings = recordings;
    this.changed();
  }

  private take_samples(samples: Samples) {
    this.samples.push(samples);
    for (const [name, values] of Object.entries(samples.signals)) this.latest.set(name, values.at(-1) ?? NaN);
    this.frames.request();
  }

  private take_pose(poses: Poses) {
    this.odometry.move(poses);
    if (poses.truth) this.truth.move(poses.truth);
    this.frames.request();
  }

  private take_path({ done, ended }: PathEvent) {
    this.path_done = ended === null ? done : null;
    if (ended !== null && ended !== "finished") this.refuse(new Refusal(ended));
    this.changed();
  }

  private take_state(state: RobotState) {
    if (!state.open) return this.forget();
    this.state = state;
    this.lose(state.link === "lost" ? `${state.why || "The robot does not answer."} It is looked for.` : "");
    if (!this.drives) this.drive.drop();
    if (!this.is_mine) this.halted = false;
    this.changed();
  }

  private forget() {
    this.drive.drop();
    this.question = this.opened = this.state = null;
    this.lost = "";
    this.path_done = null;
    this.changed();
  }

  private lose(why: string) {
    if (this.lost === why || !this.opened) return;
    this.lost = why;
    this.changed();
  }

  private look() {
    if (this.opened && !this.lost && performance.now() - this.heard_ms > kSilence_ms)
      this.lose("Nothing has been heard of the robot for some seconds.");
  }

  /** Whoever reached the robot is there again and knows nothing of what was asked before; what is watched is asked for by whoever shows it. */
  private async come_back() {
    if (this.question === null || this.opening) return;
    this.opening = true;
    try {
      await this.enter({}).catch(() => this.enter(this.question));
    } catch (error) {
      this.lose(`The robot cannot be opened again: ${sentence_of(error)}`);
    }
    this.opening = false;
    this.changed();
  }

  private changed() {
    for (const told of this.listeners) told();
    this.frames.request();
  }
}

import { useEffect, useRef, useState } from "preact/hooks";
import type { Signal } from "./contract";
import type { Robot } from "./robot";
import { type Mode, ScopeScreen } from "./scope_screen";
import type { Condition } from "./trigger";
import { use_robot } from "./use_robot";
import { unit_text, words } from "./words";

const kMostSignals = 20;
const kRates_hz = [50, 100, 200, 500, 1000];
const kWindows_s = [0.1, 0.2, 0.5, 1, 2, 5, 10, 30];

function Signals(props: { all: Signal[]; chosen: string[]; choose: (names: string[]) => void }) {
  const { all, chosen, choose } = props;
  const groups = [...new Set(all.map((each) => each.group))];
  const names_in = (group: string) => all.filter((each) => each.group === group).map((each) => each.name);
  const toggle = (names: string[]) => {
    const off = names.every((name) => chosen.includes(name));
    const others = chosen.filter((name) => !names.includes(name));
    choose(off ? others : [...others, ...names].slice(-kMostSignals));
  };
  return (
    <details class="signals">
      <summary>
        Signals: {chosen.length} of {all.length} <small>at most {kMostSignals} at once</small>
      </summary>
      <div class="groups">
        {groups.map((group) => (
          <div key={group}>
            <button type="button" class="all" aria-label={`all of ${words(group)}`} aria-pressed={names_in(group).every((name) => chosen.includes(name))} onClick={() => toggle(names_in(group))}>
              {words(group)}
            </button>
            {names_in(group).map((name) => (
              <button type="button" key={name} aria-pressed={chosen.includes(name)} onClick={() => toggle([name])}>
                {words(name)}
              </button>
            ))}
          </div>
        ))}
      </div>
    </details>
  );
}

function TriggerFields(props: { signals: Signal[]; condition: Condition; set: (condition: Condition) => void }) {
  const { condition, set } = props;
  const unit = unit_text(props.signals.find((each) => each.name === condition.signal)?.unit ?? "");
  return (
    <>
      <label>
        Signal
        <select value={condition.signal} onChange={(event) => set({ ...condition, signal: event.currentTarget.value })}>
          {props.signals.map(({ name }) => (
            <option key={name} value={name}>{words(name)}</option>
          ))}
        </select>
      </label>
      <label>
        Edge
        <select value={condition.edge} onChange={(event) => set({ ...condition, edge: event.currentTarget.value as Condition["edge"] })}>
          <option value="rising">rising</option>
          <option value="falling">falling</option>
        </select>
      </label>
      <label>
        Level{unit && `, ${unit}`}
        <input type="number" step="any" value={condition.level} onInput={(event) => set({ ...condition, level: Number(event.currentTarget.value) })} />
      </label>
    </>
  );
}

function Recording({ robot }: { robot: Robot }) {
  const state = use_robot(robot, (each) => each.state); // once a second, for the time
  const since = useRef<number | null>(null);
  if (!state?.recording) since.current = null;
  else since.current ??= performance.now();
  const end = async () => {
    try {
      const { file } = await robot.backend.ask<{ file: string }>("robot/record", { on: false });
      await robot.save_recording(file);
    } catch (error) {
      robot.refuse(error);
    }
  };
  return since.current === null ? (
    <button type="button" class="outline record" onClick={() => void robot.command("robot/record", { on: true })}>
      Record
    </button>
  ) : (
    <button type="button" class="record on" onClick={() => void end()}>
      Save as MCAP <small>{Math.round((performance.now() - since.current) / 1000)} s</small>
    </button>
  );
}

function Choice(props: { label: string; unit: string; all: number[]; value: number; set: (value: number) => void }) {
  return (
    <label>
      {props.label}
      <select value={props.value} onChange={(event) => props.set(Number(event.currentTarget.value))}>
        {props.all.map((each) => (
          <option key={each} value={each}>{each} {props.unit}</option>
        ))}
      </select>
    </label>
  );
}

/** Any signals over time, as an oscilloscope shows them. */
export function Scope({ robot, usual }: { robot: Robot; usual: string[] }) {
  const all = use_robot(robot, (each) => each.opened)?.signals ?? [];
  const [chosen, choose] = useState(usual);
  const [rate_hz, set_rate] = useState(200);
  const [window_s, set_window] = useState(5);
  const [mode, set_mode] = useState<Mode>("roll");
  const [condition, set_condition] = useState<Condition>({ signal: usual[0]!, level: 0.1, edge: "rising" });
  const [paused, set_paused] = useState(false);
  const [earlier_s, set_earlier] = useState(0);
  const traces = all.filter((each) => chosen.includes(each.name));
  const { samples } = robot;

  useEffect(() => {
    void robot.watch(chosen, rate_hz).catch((error) => robot.refuse(error));
    if (!chosen.includes(condition.signal) && chosen[0]) set_condition({ ...condition, signal: chosen[0] });
  }, [chosen, rate_hz, all]);
  useEffect(() => () => void (samples.frozen = false), []);

  const pause = (on: boolean) => {
    samples.frozen = on;
    set_paused(on);
    set_earlier(0);
  };
  const kept_s = samples.end > 0 ? samples.time(samples.end - 1) - samples.time(samples.begin) : 0;
  return (
    <section aria-label="Scope" class="panel scope">
      <div class="head">
        <h2>Scope</h2>
        <span class="spring" />
        <button type="button" class="outline" onClick={() => pause(!paused)}>
          {paused ? "Go on" : "Pause"}
        </button>
        <Recording robot={robot} />
      </div>
      <div class="settings">
        <Choice label="Window" unit="s" all={kWindows_s} value={window_s} set={set_window} />
        <Choice label="Rate" unit="Hz" all={kRates_hz} value={rate_hz} set={set_rate} />
        <label>
          Trigger
          <select value={mode} onChange={(event) => { set_mode(event.currentTarget.value as Mode); pause(false); }}>
            <option value="roll">off</option>
            <option value="each">each time</option>
            <option value="once">once</option>
          </select>
        </label>
        {mode !== "roll" && <TriggerFields signals={traces} condition={condition} set={set_condition} />}
        {paused && kept_s > window_s && (
          <label class="earlier">
            Earlier, s
            <input type="range" min="0" max={kept_s - window_s} step="any" value={earlier_s} onInput={(event) => set_earlier(Number(event.currentTarget.value))} />
          </label>
        )}
      </div>
      <ScopeScreen robot={robot} traces={traces} window_s={window_s} mode={mode} condition={condition} paused={paused} earlier_s={earlier_s} caught={() => pause(true)} />
      <Signals all={all} chosen={chosen} choose={choose} />
    </section>
  );
}

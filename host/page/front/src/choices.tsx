import { useId } from "preact/hooks";

/** What a person chooses about the simulated robot, in the units that people see. */
export interface Choice {
  name: string;
  label: string;
  unit: string;
  least: number;
  most: number;
  step: number;
  usual: number;
  hint: string;
}

export const kChoices: Choice[] = [
  { name: "E_d", label: "Right wheel larger by", unit: "%", least: -2, most: 2, step: 0.01, usual: 0.42, hint: "makes straight lines bend" },
  { name: "E_b", label: "Wheelbase larger by", unit: "%", least: -3, most: 3, step: 0.01, usual: -0.48, hint: "makes turns too far or too short" },
  { name: "S", label: "Both wheels larger by", unit: "%", least: -2, most: 2, step: 0.01, usual: 0, hint: "makes ways too long or too short" },
  { name: "e", label: "Gentle arcs turn otherwise by (e)", unit: "%", least: 0, most: 10, step: 0.1, usual: 0, hint: "what wide or soft tyres do" },
  { name: "slip", label: "Slip", unit: "times", least: 0, most: 30, step: 0.5, usual: 1, hint: "1 is that of a robot of 4.7 kg on a hall's floor" },
  { name: "seed", label: "Which robot (seed)", unit: "", least: 1, most: 999, step: 1, usual: 1, hint: "the same number drives the same again" },
];

export const kUsual = Object.fromEntries(kChoices.map((each) => [each.name, each.usual]));

/** As the calls take it. */
export const question_of = (chosen: Record<string, number>) => ({
  E_d: 1 + chosen.E_d! / 100,
  E_b: 1 + chosen.E_b! / 100,
  S: 1 + chosen.S! / 100,
  e: chosen.e! / 100,
  slip: chosen.slip,
  seed: chosen.seed,
});

export function Slider(props: { choice: Choice; value: number; disabled: boolean; set: (value: number) => void }) {
  const { choice } = props;
  const id = useId();
  const change = (event: { currentTarget: HTMLInputElement }) => props.set(Number(event.currentTarget.value));
  return (
    <div class="choice">
      <label for={id}>
        {choice.label}
        <small>{choice.hint}</small>
      </label>
      <input id={id} type="range" min={choice.least} max={choice.most} step={choice.step} value={props.value}
        disabled={props.disabled} onInput={change} />
      <span class="entered">
        <input type="number" aria-label={`${choice.label}, ${choice.unit}`} min={choice.least} max={choice.most} step={choice.step}
          value={props.value} disabled={props.disabled} onChange={change} />
        {choice.unit}
      </span>
    </div>
  );
}

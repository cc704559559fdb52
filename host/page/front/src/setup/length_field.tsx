export interface Length {
  value: number;
  unit: string;
}

/** A length as a person measured it, in one of these units. */
export function LengthField(props: { label: string; length: Length; units: string[]; set: (length: Length) => void }) {
  const { label, length, units, set } = props;
  return (
    <>
      <label>
        {label}
        <input type="number" min="0" step="any" required value={length.value} onInput={(event) => set({ ...length, value: event.currentTarget.valueAsNumber })} />
      </label>
      {units.length > 1 ? (
        <label>
          Unit
          <select value={length.unit} onChange={(event) => set({ ...length, unit: event.currentTarget.value })}>
            {units.map((each) => <option key={each}>{each}</option>)}
          </select>
        </label>
      ) : (
        <span class="unit">{units[0]}</span>
      )}
    </>
  );
}

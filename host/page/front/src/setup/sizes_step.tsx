import { useEffect, useState } from "preact/hooks";
import { type Length, LengthField } from "./length_field";
import { parameter } from "./put_in_force";
import { Problem, type StepProps, use_work } from "./step";

const kPerMetre: Record<string, number> = { mm: 1000, cm: 100, m: 1 };
const kUnits = Object.keys(kPerMetre);
const in_mm = (metres: number): Length => ({ value: Number((1000 * metres).toFixed(2)), unit: "mm" });
const metres_of = ({ value, unit }: Length) => value / kPerMetre[unit]!;

/** Wheel diameter and wheelbase as a tape measure shows them. */
export function SizesStep({ robot, load, finish }: StepProps) {
  const [diameter, set_diameter] = useState<Length | null>(null);
  const [wheelbase, set_wheelbase] = useState<Length | null>(null);
  const { busy, problem, work } = use_work();
  // Another program may have changed them.
  useEffect(
    () =>
      work(async () => {
        await robot.read_parameters();
        set_diameter(in_mm(parameter(robot, "wheel_diameter")));
        set_wheelbase(in_mm(parameter(robot, "b")));
      }),
    [],
  );
  if (!diameter || !wheelbase) return <Problem sentence={problem} />;
  const take = () =>
    work(async () => {
      const values = { wheel_diameter: metres_of(diameter), b: metres_of(wheelbase) };
      if (await load(values, false)) finish([`wheel diameter ${(1000 * values.wheel_diameter).toFixed(1)} mm, wheelbase ${(1000 * values.b).toFixed(1)} mm by tape`]);
    });
  return (
    <>
      <p>
        Measure both with a tape. The wheelbase is the distance between the middles of the two tyres where they touch the floor. A
        millimetre is enough: the calibration finds the rest.
      </p>
      <form class="settings sizes" onSubmit={(event) => { event.preventDefault(); take(); }}>
        <div><LengthField label="Wheel diameter" length={diameter} set={set_diameter} units={kUnits} /></div>
        <div><LengthField label="Wheelbase" length={wheelbase} set={set_wheelbase} units={kUnits} /></div>
        <button type="submit" disabled={busy} aria-busy={busy}>They are right: load them</button>
      </form>
      <Problem sentence={problem} />
    </>
  );
}

export interface Factors {
  c_R: number;
  c_L: number;
  b_m: number;
  e: number;
}

/** A column of the table of factors; a factor that is missing is shown as a dash. */
export interface FactorColumn {
  title: string;
  factors: Partial<Record<keyof Factors, number | null>> | null | undefined;
}

const kRows = [
  ["c_R", "c_R", 1, 6, ""],
  ["c_L", "c_L", 1, 6, ""],
  ["b_m", "b", 1000, 3, "mm"],
  ["e", "e", 1, 4, ""],
] as const;

const shown = (value: number | undefined | null, scale: number, digits: number) =>
  value === undefined || value === null ? "–" : (scale * value).toFixed(digits);

export function FactorTable({ columns }: { columns: FactorColumn[] }) {
  return (
    <div class="wide" tabIndex={0} role="group" aria-label="Factors">
      <table>
        <thead>
          <tr>
            <th scope="col">Factor</th>
            {columns.map((each) => (
              <th scope="col" key={each.title}>
                {each.title}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {kRows.map(([key, name, scale, digits, unit]) => (
            <tr key={key}>
              <th scope="row">
                {name} {unit && <small>{unit}</small>}
              </th>
              {columns.map((each) => (
                <td key={each.title}>{shown(each.factors?.[key], scale, digits)}</td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

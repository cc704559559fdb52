import type { Table, WheelsFound } from "./drive_files";
import { id_of, repeatable } from "./statements";

const side_of = (role: string) => (role.startsWith("left") ? "left" : role.startsWith("right") ? "right" : role.startsWith("time") ? "time" : "");

/**
 * What the columns of a table are, each with a menu. A statement names all of them: those that nobody changed keep their own
 * names, and one that was taken for what another now is becomes unused.
 */
export function Columns(props: {
  name: "wheel_columns" | "truth_columns";
  title: string;
  table: Table;
  taken: WheelsFound["columns"] | null;
  roles: string[];
  stated: string | undefined;
  state: (columns: string | undefined) => void;
}) {
  const { table, taken, roles } = props;
  const all = Array.from({ length: table.columns }, (_, i) => i);
  const own = all.map((i) => repeatable(table.names[i]));
  const now = props.stated?.split(",") ?? own;
  const shown_name = (i: number) => table.names[i] ?? `column ${i + 1}`;
  const recognised = (i: number) => {
    if (!taken) return "";
    if (taken.time === shown_name(i)) return "time";
    if (taken.left.includes(shown_name(i))) return "left";
    return taken.right.includes(shown_name(i)) ? "right" : "";
  };
  const change = (column: number, role: string) => {
    const next = all.map((i) => {
      if (i === column) return role;
      const same = side_of(role) !== "" && (side_of(now[i] ?? "") === side_of(role) || (now[i] === own[i] && recognised(i) === side_of(role)));
      return same ? "-" : (now[i] ?? "-");
    });
    props.state(next.every((each, i) => each === own[i]) ? undefined : next.join(","));
  };
  return (
    <div class="wide" tabIndex={0} role="group" aria-label={props.title}>
      <table class="columns">
        <thead>
          <tr>
            {all.map((i) => (
              <th scope="col" key={i}>
                {shown_name(i)}
                {recognised(i) && <small> is {recognised(i)}</small>}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          <tr>
            {all.map((i) => (
              <td key={i}>
                <select id={i === 0 ? id_of(props.name) : undefined} aria-label={`${shown_name(i)} is`} value={now[i] ?? "-"}
                  onChange={(event) => change(i, event.currentTarget.value)}>
                  <option value={own[i]}>{own[i] === "-" ? "not used" : "as its name says"}</option>
                  {own[i] !== "-" && <option value="-">not used</option>}
                  {roles.filter((role) => role !== own[i]).map((role) => (
                    <option value={role} key={role}>
                      {role.replace("_", ", ").replaceAll("_", "/")}
                    </option>
                  ))}
                </select>
              </td>
            ))}
          </tr>
          {table.rows.map((row, r) => (
            <tr key={r}>
              {row.map((cell, i) => (
                <td key={i}>{cell}</td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

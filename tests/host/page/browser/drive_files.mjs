/** What the page asks of the robot of these files, by the labels of the fields. */
export const sizes = { "Wheel diameter": "72", "Wheelbase, mm": "290", "Counts per turn": "2803.2" };

/** Tables of a robot with wheels of 72 mm, 290 mm apart and 2803.2 counts a turn, which winds to and fro for a minute. */
export function drive_files() {
  const per_metre = 2803.2 / (Math.PI * 0.072), half_base = 0.145, step_s = 0.001;
  let [x, y, theta, left, right] = [0, 0, 0, 0, 0];
  const wheels = [], truth = [];
  for (let i = 0; i <= 62_000; ++i) {
    const t = i * step_s;
    if (i % 20 === 0) {
      wheels.push(`${t.toFixed(3)},${Math.round(left * per_metre)},${Math.round(right * per_metre)}\n`);
      truth.push(`${t.toFixed(3)},${x.toFixed(6)},${y.toFixed(6)},${theta.toFixed(6)}\n`);
    }
    const moves = t > 1 && t < 61;
    const v = moves ? 0.3 * step_s : 0, turn = moves ? Math.sin(t / 3) * step_s : 0;
    x += v * Math.cos(theta + turn / 2);
    y += v * Math.sin(theta + turn / 2);
    theta += turn;
    left += v - half_base * turn;
    right += v + half_base * turn;
  }
  const file = (name, head, lines) => ({ name, mimeType: "text/csv", buffer: Buffer.from(`${head}\n${lines.join("")}`) });
  return [file("wheels.csv", "time_s,left_counts,right_counts", wheels), file("truth.csv", "time_s,x_m,y_m,theta_rad", truth)];
}

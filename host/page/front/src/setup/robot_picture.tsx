/** How far each wheel has turned, in turns, forward positive. */
export interface Turned {
  left: number;
  right: number;
}

const kLeast = 0.02;
const kTreads = [0, 1, 2, 3, 4, 5, 6, 7];

function Wheel({ x, turned }: { x: number; turned: number }) {
  const way = Math.abs(turned) < kLeast ? "" : turned > 0 ? " ahead" : " back";
  return (
    <svg x={x} y="62" width="22" height="76" class={`wheel-of-picture${way}`}>
      <rect width="22" height="76" rx="5" />
      <g>{kTreads.map((i) => <line key={i} x1="3" x2="19" y1={i * 12 - 8} y2={i * 12 - 8} />)}</g>
    </svg>
  );
}

/** The robot from above, its front up. Wheels that were seen turning turn. */
export function RobotPicture({ turned }: { turned: Turned | null }) {
  return (
    <svg class="robot-picture" viewBox="0 0 220 200" role="img" aria-label="The robot from above, its front is up">
      <rect x="42" y="30" width="136" height="150" rx="18" class="body" />
      <path d="M110 8 l12 16 h-24 z" class="front" />
      <text x="110" y="50">front</text>
      <circle cx="110" cy="160" r="9" class="caster" />
      <text x="72" y="104">left</text>
      <text x="146" y="104">right</text>
      <Wheel x={18} turned={turned?.left ?? 0} />
      <Wheel x={180} turned={turned?.right ?? 0} />
    </svg>
  );
}

/** What people read for a name of the robot: of a signal, a fault, or a mode. */
export const words = (name: string) => name.replaceAll("_", " ");

/** A unit as people write it: a number alone has none. */
export const unit_text = (unit: string) => (unit === "1" ? "" : unit);

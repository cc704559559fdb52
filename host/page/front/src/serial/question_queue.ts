import type { SharedBytes } from "./shared_bytes";

/** What the page asks of a robot. */
export interface RobotQuestion {
  id: number;
  call: string;
  question: unknown;
  /** By Date.now(), the clock that a page and its workers have in common. */
  asked_ms: number;
}

/** Which calls stop the robot, and which may make it move. */
export interface Rules {
  stops(call: string): boolean;
  moves(call: string): boolean;
}

/** False if there is no room. */
export const put_question = (queue: SharedBytes, question: RobotQuestion) => queue.put(new TextEncoder().encode(`${JSON.stringify(question)}\n`));

/** All that were asked so far. */
export function take_questions(queue: SharedBytes): RobotQuestion[] {
  // A measurement asks some thousand times a second.
  if (queue.waiting === 0) return [];
  const bytes = new Uint8Array(queue.waiting);
  queue.take(bytes);
  const lines = new TextDecoder().decode(bytes).split("\n");
  return lines.slice(0, -1).map((line) => JSON.parse(line) as RobotQuestion);
}

/**
 * The questions that wait in the worker. As where a program answers: what stops the robot overtakes all else, and what was asked before to
 * move it is withdrawn.
 */
export class WaitingQuestions {
  private urgent: RobotQuestion[] = [];
  private others: RobotQuestion[] = [];

  constructor(
    private queue: SharedBytes,
    private rules: Rules,
    private withdraw: (question: RobotQuestion) => void,
  ) {}

  /** The next one, also from within the answer to another. */
  next(): RobotQuestion | undefined {
    for (const each of take_questions(this.queue)) this.push(each);
    return this.urgent.shift() ?? this.others.shift();
  }

  private push(question: RobotQuestion) {
    if (!this.rules.stops(question.call)) {
      this.others.push(question);
      return;
    }
    this.urgent.push(question);
    const moves = (each: RobotQuestion) => this.rules.moves(each.call);
    this.others.filter(moves).forEach((each) => this.withdraw(each));
    this.others = this.others.filter((each) => !moves(each));
  }
}

/**
 * What the page asks the core, and what the core answers.
 *
 * The worker (worker.ts) hands a request to the core as JSON text and returns the parsed answer. An answer of a command is the JSON of that
 * command (`jred size --format json`), key for key and bit for bit: docs/json.md.
 */

/** A machine file with the files that it names, by the names it uses for them. */
export interface Source {
  name: string;
  text: string;
  files?: Record<string, string>;
}

/** The gallery, `machines.json` beside the page: made by `scripts/page build` from the folder machines/. */
export interface GalleryMachine extends Source {
  title: string;
}

export type Request =
  /** The curves over one turn or the stroke: `jred reduce --positions N`. */
  | ({ do: 'curves'; positions?: number; over?: 'angle' | 'time' } & Source)
  /** The machine drawn: an SVG, and a track to move its groups by. */
  | ({ do: 'drawing' } & Source)
  /** `jred size`. With a `drive` ("MOTOR+GEARBOX") that drive alone is judged, with `best` that which ranks first: for sliders. */
  | ({ do: 'size'; drive?: string; best?: boolean; explain?: boolean; top?: number } & Source)
  /** The duty of a drive in the torque-speed plane, its limits, and its course over the cycle; without `drive` of the first that fits. */
  | ({ do: 'charts'; drive?: string } & Source)
  /** `jred fastest`; without `drive` of the first that fits. */
  | ({ do: 'fastest'; drive?: string } & Source)
  /** `jred gentlest`. */
  | ({ do: 'gentlest'; drive?: string } & Source)
  /** `jred steady`: the steady cycle, and the flywheel for the fluctuation `delta`. */
  | ({ do: 'flywheel'; delta?: number } & Source)
  /** A file to download: the table of `jred export` in this form. `torqueError` such as "0.5 N m"; `day` is the date of a PLCopen file. */
  | ({ do: 'export'; form: ExportForm; torqueError: string; day?: string } & Source)
  /** The HTML report of `jred size --report`; takes about a second. */
  | ({ do: 'report'; day: string; drive?: string } & Source)
  /** Every quantity of the text, for sliders. */
  | ({ do: 'quantities' } & Source)
  /** The text with quantities replaced in place, for example `{ "slider.mass": "43 kg" }`. */
  | ({ do: 'set'; values: Record<string, string> } & Source)
  /** What may be written at a place of the text (offset in UTF-16 units). */
  | ({ do: 'complete'; at: number } & Source)
  /** Whether a linkage under construction moves; its text is written by the page (draw/write.ts). */
  | ({ do: 'draw' } & Source)
  /** The pins and guides of a machine, to be changed by hand. */
  | ({ do: 'linkage' } & Source);

export type ExportForm = 'image' | 'c' | 'rust' | 'json' | 'st' | 'plcopen';

/** `answer` of each request. */
export interface Answers {
  curves: Columns;
  drawing: Drawing;
  size: SizeAnswer;
  charts: Charts;
  /** `jred fastest --format json`: docs/schemas/fastest.json. */
  fastest: Record<string, unknown>;
  /** docs/schemas/gentlest.json */
  gentlest: Record<string, unknown>;
  /** docs/schemas/steady.json */
  flywheel: Record<string, unknown>;
  export: Download;
  report: { html: string };
  quantities: Quantity[];
  set: { text: string };
  complete: Completion;
  draw: Drawn;
  linkage: Pins;
}

export type Answer<D extends Request['do']> = { answer: Answers[D]; warnings: string[] } | { error: Fault };

/** A fault of the text, or of what is asked for. */
export interface Fault {
  message: string;
  /** How to mend it; may be empty. */
  help: string;
  /** Places in the text; `line` and `column` count from 1, `from` and `to` are offsets in UTF-16 units. Empty if it has no place in the text. */
  places: { from: number; to: number; line: number; column: number; label: string }[];
  /** The name of the file of these places, if it is not the machine file. */
  file?: string | null;
  /** The core panicked and was started anew; `message` is the panic's. */
  panic?: true;
  /** The sheet holds no machine that moves. */
  sheet?: true;
}

/** Named columns: "phi [deg]", "J_red [kg m^2]", …, "T_drive [N m]"; null where there is no value. */
export interface Columns {
  schema: string;
  title: string;
  notes: string[];
  columns: string[];
  rows: (number | null)[][];
  /** The same over time, if the drive comes to one place with several speeds: its torque is no function of the place. */
  path?: Columns;
}

/** See `Animation` in tool/report/src/drawing.rs. */
export interface Drawing {
  /** Groups `[data-link="k"]` and `[data-point="k"]` carry the transform "translate(x y) rotate(a)". */
  svg: string;
  track: {
    /** Position of each frame (deg, or mm of a drive link that slides). */
    positions: number[];
    /** x, y (px) and angle (deg) of each link, for each frame. */
    links: number[][];
    /** x, y (px) of each point, for each frame. */
    points: number[][];
    /** The first frame follows the last. */
    turn: boolean;
    /** Frame of `svg`. */
    first: number;
  };
}

/** The parts of docs/schemas/size.json that the page shows. */
export interface SizeAnswer {
  title: string;
  warnings: string[];
  ranking: string;
  counts: { drives: number; fit: number; 'fit, not all rules checked': number; refused: number };
  fit: SizedDrive[];
  refused: SizedDrive[];
  asked?: SizedDrive;
  explanation?: Record<string, unknown>;
  'bill of materials'?: { key: string; maker: string; order: string }[];
  [key: string]: unknown;
}

export interface SizedDrive {
  motor: string;
  gearbox: string | null;
  amplifier: string | null;
  ratio: number;
  'mass [kg]': number | null;
  'rated power [W]': number | null;
  verdict: 'pass' | 'warn' | 'fail' | string;
  rank?: number | null;
  checks: Record<string, unknown>[];
  assumptions: string[];
  [key: string]: unknown;
}

/** Charts of the report, as numbers. */
export interface Charts {
  drive: string;
  charts: Chart[];
}

export interface Chart {
  /** "plane", "torque", "speed", "power", "temperature", "bus" */
  name: string;
  form: 'plane' | 'time' | 'course';
  x: string;
  y: string;
  right: string;
  /** Lists of abscissae; each series names one by its index. */
  places: (number | null)[][];
  series: {
    name: string;
    style: 'line' | 'dashed' | 'dots';
    colour: string;
    /** On the second vertical axis. */
    right: boolean;
    /** Index of its abscissae. */
    at: number;
    y: (number | null)[];
    /** Of the duty in the plane: the time of each point (s). */
    t?: number[];
  }[];
}

export interface Download {
  name: string;
  /** One of both. */
  text?: string;
  bytes?: number[];
  /** The answer of `jred export`: docs/schemas/export.json. */
  about: Record<string, unknown>;
}

export interface Quantity {
  /** "mechanism.slider.mass" */
  key: string;
  /** Meaning of its key, from the documentation of machine files; may be empty. */
  help: string;
  number: number;
  /** As written; empty for a plain number. */
  unit: string;
  /** A count. */
  whole: boolean;
  /** A range for a slider, in `unit`; `min` is a limit where the key has one. */
  min: number;
  max: number;
  /** Place in the text (UTF-16 units). */
  from: number;
  to: number;
}

export interface Completion {
  /** The part of the text that a candidate replaces (UTF-16 units). */
  from: number;
  to: number;
  candidates: { label: string; detail: string; insert: string }[];
}

/** A linkage as it is drawn; lengths in mm, angles in degrees, masses in kg. */
export interface Linkage {
  title: string;
  points: { name: string; x: number; y: number; ground?: boolean }[];
  /**
   * Bodies through their points. A point on several bodies is a pin between them; a ground point is a bearing. `com` in the frame of the body: from
   * its first point, u towards the second; not given: the middle of its points. `inertia` (kg m²) not given: that of a slender rod.
   */
  bodies: { name: string; points: string[]; mass?: number; inertia?: number; com?: [number, number] }[];
  /** A point that slides along a line through its place at an angle; on the ground, or on the body `on`. `mass` is that of its block (`body`). */
  guides: { point: string; angle: number; on?: string; body?: string; mass?: number }[];
  /** The pin (a ground point) that is driven, or the name of the guided point. */
  drive: string;
  /** Constant speed of the drive (rpm; mm/s if it slides); not given: the motion in `rest`. */
  speed?: number;
  /** At a point, or with moments (N m) at a body (`at` is empty). */
  loads: { name: string; on: string; at: string; force?: [number, number]; opposing?: number; moment?: number; opposingMoment?: number }[];
  /** Tables of the machine file that the sheet does not show, as they are. */
  rest?: string;
  /** Down: [0, −9.81] (m/s²). */
  gravity?: [number, number];
  flywheel?: number;
}

export interface Drawn {
  /** What hinders it, in words; empty if the linkage moves. The cure of a dead point proposes a line `stroke = […]`. */
  obstacle: string;
  cure: string;
  /** Range of the drive (deg or mm); null: it turns on and on. */
  range: [number, number] | null;
  /** Dead centres of links, in words with their places. */
  dead: string[];
}

/** A machine as links, pins and guides at one position (m, rad). */
export interface Pins {
  title: string;
  gravity: [number, number];
  /** kg m² at the drive */
  flywheel: number;
  /** Two bodies, null is the ground; none of a joint that is neither pin nor guide. A guide has an angle, its second body slides. */
  joints: { bodies: (string | null)[]; at: [number, number]; angle?: number }[];
  /** `frame`: origin of the link and the end of its axis u. */
  links: { name: string; mass: number; inertia: number; com: [number, number]; frame: [number, number][]; points: { name: string; at: [number, number] }[] }[];
  /** Index of the driven joint. */
  drive: number;
  /** What the machine has besides. */
  lost: string[];
}

"use strict";
// The scene of a walk that goes on: its samples are those of the last minute or so.
apnc.LiveScene = class extends apnc.Scene {
  begin() {
    const room = 8192, n = this.n;
    Object.assign(this, { room, count: 0, dropped: 0, prints: [], above: 0, time: new Float64Array(room), stance: new Uint8Array(room * n), phi: new Float32Array(room * (n - 1)) });
    for (const [name, size] of Object.entries(this.sizes())) this[name] = new Float32Array(room * size);
  }

  // Numbers of a sample in each array, in the order of a row after its time.
  sizes() { return { position: 3, rpy: 3, focus: 3, chains: 9 * this.n, force: 3 * this.n }; }

  // A row of numbers, see apnc/view/samples.py.
  append(row) {
    if (this.count === this.room) this.forget(this.room / 2);
    const i = this.count++, n = this.n;
    let at = 1;
    const take = (array, size) => { array.set(row.subarray(at, at + size), i * size); at += size; };
    this.time[i] = row[0];
    for (const [name, size] of Object.entries(this.sizes())) take(this[name], size);
    take(this.stance, n);
    take(this.phi, n - 1);
    this.turnOf = -1;
    if (!this.above) this.above = this.focus[2] - this.track(0)[2];
    for (let leg = 0; leg < n; leg++) {
      if (i && this.stance[i * n + leg] && !this.stance[(i - 1) * n + leg]) this.prints.push({ i, leg, place: this.sole(i, leg) });
    }
  }

  // The oldest samples go.
  forget(some) {
    const move = (array) => array.copyWithin(0, (some * array.length) / this.room);
    for (const name of [...Object.keys(this.sizes()), "time", "stance", "phi"]) move(this[name]);
    this.count -= some;
    this.prints = this.prints.map((print) => ({ ...print, i: print.i - some })).filter((print) => print.i > 0);
  }

  get rowWidth() { return 9 + 14 * this.n; }

  // A way on the screen [px] as one on the ground [m].
  groundwards([right, down]) {
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth), se = Math.sin(this.elevation);
    const depth = se > 0.15 ? down / se : 0;
    return [ca * depth - sa * right, sa * depth + ca * right].map((v) => v / this.scale);
  }
};

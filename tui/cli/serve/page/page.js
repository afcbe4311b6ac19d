// Signs of life from the page itself, so that a browser that is gone is noticed behind a tunnel, too; the stop button.
const ALIVE_MS = 200;
const Socket = window.WebSocket;

// Keys reach the console wherever the focus was: nobody should have to click before ! works.
const takeKeys = () => document.querySelector(".xterm-helper-textarea")?.focus();
window.addEventListener("focus", takeKeys);
window.addEventListener("keydown", takeKeys, { capture: true });

window.WebSocket = class extends Socket {
  constructor(...words) {
    super(...words);
    window.consoleSocket = this;
    const timer = setInterval(() => {
      if (this.readyState === Socket.OPEN && !document.hidden) this.send('["alive"]');
    }, ALIVE_MS);
    this.addEventListener("open", takeKeys);
    this.addEventListener("close", () => clearInterval(timer));
  }
};

window.addEventListener("DOMContentLoaded", () => {
  // The terminal's room also changes without the window: a device may turn out to have no mouse.
  new ResizeObserver(() => window.onresize?.()).observe(document.getElementById("terminal"));
  document.getElementById("again").addEventListener("click", () => window.location.reload());
  document.getElementById("stop-button").addEventListener("click", () => {
    window.consoleSocket.send(JSON.stringify(["stdin", "!"]));
  });
});

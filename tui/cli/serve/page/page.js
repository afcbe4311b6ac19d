// Sends signs of life, so that a closed browser is noticed even behind a tunnel; handles the stop button.
const ALIVE_MS = 200;
const Socket = window.WebSocket;

// Keys reach the console wherever the focus is, so that ! works without a click.
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
  // The space for the terminal may also change without the window, when a device turns out to have no mouse.
  new ResizeObserver(() => window.onresize?.()).observe(document.getElementById("terminal"));
  document.getElementById("again").addEventListener("click", () => window.location.reload());
  document.getElementById("stop-button").addEventListener("click", () => {
    window.consoleSocket.send(JSON.stringify(["stdin", "!"]));
  });
});

// Browsers start no workers for pages that lie in a folder: there the search works in a hidden frame instead.
if (location.protocol === "file:") {
  window.IFrameWorker = class extends EventTarget {
    constructor(address) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.append(frame);
      const inside = frame.contentWindow;
      this.begun = new Promise((done) => { frame.addEventListener("load", () => done(inside)); });
      addEventListener("message", (event) => {
        if (event.source === inside) this.dispatchEvent(new MessageEvent("message", { data: event.data }));
      });
      const bridge = "postMessage = (data) => parent.postMessage(data, '*');"
        + "importScripts = async (...all) => { for (const src of all) await new Promise((done) => {"
        + "const script = document.createElement('script'); script.onload = done; script.src = src;"
        + "document.body.append(script); }); };";
      inside.document.write(`<body><script>${bridge}<\/script><script src="${address}"><\/script></body>`);
      inside.document.close();
    }

    postMessage(data) {
      this.begun.then((inside) => inside.dispatchEvent(new MessageEvent("message", { data })));
    }

    terminate() {}
  };
  window.Worker = window.IFrameWorker;
}

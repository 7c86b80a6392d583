// One upload: XMLHttpRequest tells how far it is, which fetch does not.

import { Refusal } from "./choosing.js";

const BROKEN = "The connection broke before everything was sent. Try again.";

// Starts to send a file and returns {answer, stop}; `answer` is the service's, or a Refusal.
export function sending(file, name, { profile, token }, told) {
  const form = new FormData();
  if (profile) form.append("profile", profile);
  form.append("file", file, name);
  const request = new XMLHttpRequest();
  request.open("POST", "/api/checks");
  request.setRequestHeader("Accept", "application/json");
  if (token) request.setRequestHeader("Authorization", `Bearer ${token}`);
  request.upload.addEventListener("progress", (event) => told(event.loaded / event.total));
  const answer = new Promise((resolve, reject) => {
    request.addEventListener("load", () => {
      if (request.status === 201) resolve(JSON.parse(request.responseText));
      else reject(new Refusal(saidBy(request)));
    });
    request.addEventListener("error", () => reject(new Refusal(BROKEN)));
    request.addEventListener("abort", () => reject(new Refusal("Stopped: the service keeps nothing of the upload.")));
  });
  request.send(form);
  return { answer, stop: () => request.abort() };
}

// The service refuses with two sentences; what stands between may answer in HTML.
function saidBy(request) {
  try {
    const { error, advice } = JSON.parse(request.responseText);
    if (error) return [error, advice].filter(Boolean).join(" ");
  } catch {
    // Falls through to what the status alone tells.
  }
  return `The service answered with status ${request.status}. Try again later.`;
}

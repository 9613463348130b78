/**
 * Service worker: the page without a network. The network is asked first, so that a new version is seen; what it gave is kept and answers without it.
 */
interface Lasting extends Event {
  waitUntil(work: Promise<unknown>): void;
}
interface Fetched extends Event {
  request: Request;
  respondWith(response: Promise<Response>): void;
}
interface ServiceWorkerScope {
  addEventListener(kind: 'install' | 'activate', listener: (event: Lasting) => void): void;
  addEventListener(kind: 'fetch', listener: (event: Fetched) => void): void;
  clients: { claim(): Promise<void> };
  skipWaiting(): Promise<void>;
}

const worker = self as unknown as ServiceWorkerScope;
const KEPT = 'jred-page';

worker.addEventListener('install', (event) => {
  event.waitUntil((async () => {
    const listed = await fetch('files.json', { cache: 'no-cache' });
    const cache = await caches.open(KEPT);
    await cache.addAll(['./', ...((await listed.json()) as string[])]);
    await worker.skipWaiting();
  })());
});

worker.addEventListener('activate', (event) => event.waitUntil(worker.clients.claim()));

worker.addEventListener('fetch', (event) => {
  const { request } = event;
  if (request.method !== 'GET' || new URL(request.url).origin !== location.origin) return;
  event.respondWith((async () => {
    try {
      const fresh = await fetch(request);
      if (fresh.ok) {
        const cache = await caches.open(KEPT);
        await cache.put(request, fresh.clone());
      }
      return fresh;
    } catch {
      return (await caches.match(request, { ignoreSearch: true })) ?? Response.error();
    }
  })());
});

export {};

//! Threads that take environments from a queue, let each carry out one order, and queue them where they are received.

use super::slot::{Order, Slot};
use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// An environment on its way: its index, itself, and what it is to do.
pub struct Job {
    pub index: usize,
    pub slot: Box<Slot>,
    pub order: Order,
}

#[derive(Default)]
struct Queues {
    jobs: VecDeque<Job>,
    finished: VecDeque<(usize, Box<Slot>)>,
    closing: bool,
}

#[derive(Default)]
struct Shared {
    queues: Mutex<Queues>,
    /// There are jobs, or there will be none.
    work: Condvar,
    /// An environment has finished.
    done: Condvar,
}

impl Shared {
    /// Nothing panics while it holds the lock, so that what it guards is whole.
    fn lock(&self) -> MutexGuard<'_, Queues> {
        self.queues.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn work(&self) {
        let idle = |queues: &mut Queues| queues.jobs.is_empty() && !queues.closing;
        let mut queues = self.lock();
        loop {
            queues = self.work.wait_while(queues, idle).unwrap_or_else(PoisonError::into_inner);
            if queues.closing {
                return;
            }
            let Some(Job { index, mut slot, order }) = queues.jobs.pop_front() else { continue };
            drop(queues);
            slot.run(order);
            queues = self.lock();
            queues.finished.push_back((index, slot));
            self.done.notify_one();
        }
    }
}

/// Running threads. Dropping them waits for the orders in progress, and forgets those that no thread has begun.
pub struct Workers {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
    /// The process that started them: a fork has none of its parent's threads.
    process: u32,
}

impl Workers {
    /// Starts `count` threads.
    ///
    /// # Errors
    /// The system refuses a thread.
    pub fn start(count: usize) -> std::io::Result<Self> {
        let shared = Arc::<Shared>::default();
        let mut workers = Workers { shared, threads: Vec::new(), process: std::process::id() };
        for index in 0..count {
            let shared = workers.shared.clone();
            let builder = std::thread::Builder::new().name(format!("robohive-async-{index}"));
            workers.threads.push(builder.spawn(move || shared.work())?);
        }
        Ok(workers)
    }

    /// Whether these threads belong to another process, from which this one was forked.
    pub fn are_foreign(&self) -> bool {
        self.process != std::process::id()
    }

    /// Queues orders.
    pub fn send(&self, jobs: impl IntoIterator<Item = Job>) {
        let mut queues = self.shared.lock();
        queues.jobs.extend(jobs);
        drop(queues);
        self.shared.work.notify_all();
    }

    /// Waits until `count` environments have finished, and returns these, the one that finished first at the front. So
    /// many must be under way.
    pub fn receive(&self, count: usize) -> Vec<(usize, Box<Slot>)> {
        let few = |queues: &mut Queues| queues.finished.len() < count;
        let queues = self.shared.lock();
        let mut queues = self.shared.done.wait_while(queues, few).unwrap_or_else(PoisonError::into_inner);
        queues.finished.drain(..count).collect()
    }
}

impl Drop for Workers {
    fn drop(&mut self) {
        if self.are_foreign() {
            // There are no threads to wait for, and the lock may be in the hands of one that is not here.
            self.threads.drain(..).for_each(std::mem::forget);
            return;
        }
        self.shared.lock().closing = true;
        self.shared.work.notify_all();
        for thread in self.threads.drain(..) {
            // A worker cannot panic: `Slot::run` catches.
            let _ = thread.join();
        }
    }
}

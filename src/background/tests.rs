//! Tests of the hand-over.

use super::*;

fn background<In: Send + 'static, Out: Send + 'static>(
    mut work: impl FnMut(In) -> Out + Send + 'static,
) -> Background<In, (), Out> {
    Background::new("test", "the test", Arc::new(|| ()), move |input, _| Ok(work(input))).unwrap()
}

fn wait<In, Progress, Out>(b: &mut Background<In, Progress, Out>) -> Result<Out, String>
where
    In: Send + 'static,
    Progress: Clone + Default + PartialEq + Send + 'static,
    Out: Send + 'static,
{
    let end = Instant::now() + Duration::from_secs(10);
    loop {
        if let Some(result) = b.take() {
            return result;
        }
        assert!(Instant::now() < end, "the job never ended");
        thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn the_newest_job_wins_and_superseded_ones_are_not_started() {
    let (started, log) = mpsc::channel();
    let (go, gate) = mpsc::channel::<()>();
    let mut b = background(move |n: u32| {
        started.send(n).unwrap();
        gate.recv().unwrap();
        n * 10
    });
    b.start(1);
    assert_eq!(log.recv().unwrap(), 1);
    for n in 2..=5 {
        b.start(n);
    }
    go.send(()).unwrap();
    assert_eq!(log.recv().unwrap(), 5, "2 to 4 were overtaken");
    assert!(b.take().is_none(), "the result of 1 is stale");
    assert!(b.is_busy());
    go.send(()).unwrap();
    assert_eq!(wait(&mut b), Ok(50));
    assert!(!b.is_busy());
    assert!(b.take().is_none(), "once");
}

#[test]
fn a_cancelled_job_has_no_result() {
    let mut b = background(|n: u32| n);
    b.start(1);
    b.cancel();
    assert!(!b.is_busy());
    b.start(2);
    assert_eq!(wait(&mut b), Ok(2));
    b.start(3);
    thread::sleep(Duration::from_millis(20));
    b.cancel();
    assert!(b.take().is_none() && !b.is_busy());
}

#[test]
fn a_panic_is_an_error_and_the_thread_continues() {
    let mut b = background(|n: u32| {
        assert!(n != 1, "one is too few");
        n
    });
    b.start(1);
    assert_eq!(wait(&mut b), Err("this is a bug in Eddy: the test failed (one is too few)".into()));
    b.start(2);
    assert_eq!(wait(&mut b), Ok(2));
}

#[test]
fn work_reports_progress_and_sees_its_cancellation() {
    let (woken, wakes) = mpsc::channel();
    let (heard, hears) = mpsc::channel();
    let wake = Arc::new(move || _ = woken.send(()));
    let mut b = Background::new("test", "the test", wake, move |of: usize, control: &Control<Count>| {
        control.report(Count { done: 1, of });
        while !control.is_cancelled() {
            thread::sleep(Duration::from_millis(1));
        }
        heard.send(control.check()).unwrap();
        Ok(())
    })
    .unwrap();
    let next = || wakes.recv_timeout(Duration::from_secs(10)).unwrap();
    b.start(3);
    next();
    assert!(b.poll() && !b.poll(), "news are told once");
    assert_eq!(b.status(), Some(Status::UnderWay(Count { done: 1, of: 3 })));
    b.cancel();
    assert!(hears.recv_timeout(Duration::from_secs(10)).unwrap().is_err());
    next();
    b.poll();
    assert_eq!(b.status(), None, "the result of a cancelled job is dropped");
    assert!(b.end(Duration::from_secs(10)));
}

#[test]
fn a_request_is_pending_until_its_result_arrives() {
    let mut b = background(|n: u32| n);
    assert!(!b.take_request() && b.status().is_none());
    b.request();
    assert!(b.take_request() && !b.take_request() && b.is_under_way());
    b.renew_request();
    assert!(b.take_request());
    b.fail("no input");
    assert_eq!(b.status(), Some(Status::Ended(Err("no input"))));
    b.request();
    assert!(matches!(b.status(), Some(Status::UnderWay(()))) && b.result().is_some(), "the last one stays");
    b.clear();
    assert!(b.status().is_none() && !b.take_request());
}

#[test]
fn events_arrive_in_order_and_none_is_lost() {
    let (go, gate) = mpsc::channel::<()>();
    let mut b = Background::once("test", "the test", Arc::new(|| ()), move |control: &Control<Vec<u32>>| {
        for n in 0..100 {
            control.update(|events| events.push(n));
            if n == 50 {
                gate.recv().unwrap();
            }
        }
        Ok(())
    })
    .unwrap();
    let mut told = Vec::new();
    while told.len() < 51 {
        told.extend(b.take_progress());
    }
    go.send(()).unwrap();
    assert_eq!(wait(&mut b), Ok(()));
    told.extend(b.take_progress());
    assert_eq!(told, (0..100).collect::<Vec<u32>>());
    assert!(b.take_progress().is_empty(), "each event once");
}

#[test]
fn a_stopped_job_returns_its_partial_result() {
    let (started, starts) = mpsc::channel();
    let mut b = Background::once("test", "the test", Arc::new(|| ()), move |control: &Control<()>| {
        let flag = control.cancel_flag();
        started.send(()).unwrap();
        while !flag.load(Ordering::Relaxed) {
            thread::sleep(Duration::from_millis(1));
        }
        Ok(control.is_cancelled())
    })
    .unwrap();
    starts.recv().unwrap();
    assert!(b.is_busy() && !b.is_stopping());
    b.stop();
    assert!(b.is_stopping());
    assert_eq!(wait(&mut b), Ok(true));
    assert!(!b.is_busy() && !b.is_stopping());
}

#[test]
fn a_thread_of_one_job_ends_with_it() {
    let mut b = Background::once("test", "the test", Arc::new(|| ()), |_: &Control<()>| Ok(3)).unwrap();
    assert_eq!(wait(&mut b), Ok(3));
    let end = Instant::now() + Duration::from_secs(10);
    while !b.thread.as_ref().is_some_and(JoinHandle::is_finished) {
        assert!(Instant::now() < end, "the thread waits for another job");
        thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn dropping_a_detached_job_does_not_wait() {
    let (_never, waits) = mpsc::channel::<()>();
    let work = move |_: &Control<()>| waits.recv().map_err(|e| e.to_string());
    drop(Background::once("test", "the test", Arc::new(|| ()), work).unwrap().detached());
}

#[test]
fn lazy_work_starts_its_thread_with_the_first_job() {
    let (started, has_started) = mpsc::channel();
    let mut b = Background::lazy("test", "the test", Arc::new(|| ()), move |n: u32, _: &Control<()>| {
        started.send(thread::current().name().map(str::to_owned)).unwrap();
        Ok(n + 1)
    });
    assert!(b.thread.is_none() && !b.is_under_way());
    b.cancel();
    b.start(1);
    assert_eq!(wait(&mut b), Ok(2));
    assert_eq!(has_started.recv().unwrap().as_deref(), Some("test"));
    b.start(2);
    assert_eq!(wait(&mut b), Ok(3));
}

#[test]
fn abandoned_work_is_cancelled_and_its_thread_returned() {
    let (started, has_started) = mpsc::channel();
    let work = move |(), control: &Control<()>| {
        started.send(()).unwrap();
        while !control.is_cancelled() {
            thread::sleep(Duration::from_millis(1));
        }
        Ok(())
    };
    let unused = Background::lazy("test", "the test", Arc::new(|| ()), |(), _: &Control<()>| Ok(()));
    assert!(unused.abandon().is_none(), "no thread was started");
    let mut b = Background::lazy("test", "the test", Arc::new(|| ()), work);
    b.start(());
    has_started.recv().unwrap();
    b.abandon().unwrap().join().unwrap();
}

//! dev
use maze_verify::*;
fn main() {
    let filter = std::env::args().nth(1).unwrap_or_default();
    let scenes: Vec<_> =
        scene::catalogue().into_iter().enumerate().filter(|(_, s)| s.name.contains(&filter)).collect();
    let t = std::time::Instant::now();
    let results = run(&scenes, &Contender::ALL, &build, &|name| eprintln!("{name}")).unwrap();
    eprintln!("ran {:?}", t.elapsed());
    let r = relaxation::measure().unwrap();
    eprintln!("relax {:?}", t.elapsed());
    for s in &results {
        for c in &s.cases {
            if (c.tick_s == 0.03 || c.tick_s == 0.001 || c.tick_s < 0.0042) && !s.name.contains("maze-") {
                for run in &c.runs {
                    let m = &run.metrics;
                    println!(
                        "{:22} {:.4} {:15} b{:<3} pen {:.1e} p99 {:.1e} n{:<4} own {:.1e} tun{} gain {:.1e} rest {:?} {:.0}ns",
                        s.name,
                        c.tick_s,
                        run.engine.name(),
                        m.n_bounces,
                        m.penetration_max,
                        m.penetration_p99,
                        m.n_penetrating,
                        m.own_penetration,
                        m.n_tunnels,
                        m.energy_gain_part,
                        m.rest_s.map(|t| (t * 1000.0).round() / 1000.0),
                        m.ns_per_tick
                    );
                    if let Some(e) = &m.errors {
                        println!(
                            "      pos {:.1e} ({:.2e}) rest {:?} ang {:?} vel {:?} apex {:?} {:?} en {:.1e}",
                            e.position,
                            e.position_part,
                            e.restitution.map(|v| v as f32),
                            e.angle_deg.map(|v| v as f32),
                            e.velocity.map(|v| v as f32),
                            e.apex.map(|v| v as f32),
                            e.first_apex_part.map(|v| v as f32),
                            e.energy_part
                        );
                    }
                }
            }
        }
    }
    println!("{r:#?}");
    let res = results::Results::new(results::Partition::WHOLE, scenes.len(), results, Some(r));
    println!("{}", report::table(&res));
    std::fs::write("/tmp/results.json", serde_json::to_string(&res).unwrap()).unwrap();
}

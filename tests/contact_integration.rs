//! quick
#![allow(clippy::unwrap_used, reason = "a test may fail")]
#[path = "oracle/normal_contact.rs"]
mod normal_contact;
mod common;
use normal_contact::{Impact,follow};
use nearwall::normal::*;
fn contact(i:&Impact)->Contact{Contact{density:i.density,reduced_modulus:i.reduced_modulus,work_of_adhesion:i.work_of_adhesion,yield_strength:i.limiting_pressure,yield_ratio:1.0,stiffness_ratio:1.0}}
#[test]
fn quick(){
  let e=1.0/(0.91/1.2e9+0.91/182e9);
  for v in [1.0,1.458,1.459,2.0,5.0,50.0]{
   let i=Impact{radius:2.45e-6,density:1350.0,reduced_modulus:e,work_of_adhesion:0.2,limiting_pressure:35.3e6,speed:v};
   for tol in [1e-8,1e-10,1e-12]{let b=follow(&i,tol);
   println!("{v} {:?} law {:?} oracle {}",b,NormalLaw::RaisedPullOff.restitution(&contact(&i),4.9e-6,v),b.rebound_speed/v);}
  }
  println!("{:?}",NormalLaw::RaisedPullOff.speeds(&contact(&Impact{radius:2.45e-6,density:1350.0,reduced_modulus:e,work_of_adhesion:0.2,limiting_pressure:35.3e6,speed:1.0}),4.9e-6));
  let t=std::time::Instant::now(); let mut worst=0f64;
  for (k,c) in common::golden::golden_cases().iter().enumerate(){
    let i=Impact{radius:0.5*c.d,density:c.rho,reduced_modulus:c.reduced_modulus,work_of_adhesion:c.work_of_adhesion,limiting_pressure:c.p_y,speed:c.v_n};
    let b=follow(&i,1e-10); let l=NormalLaw::RaisedPullOff.restitution(&contact(&i),c.d,c.v_n).unwrap_or(0.0);
    let d=b.rebound_speed/c.v_n-l; worst=worst.max(d.abs());
    if d.abs()>1e-8||b.energy_defect.abs()>1e-8{println!("{k} q {:e} {:e} e {l} d {d:e} defect {:e} steps {}",c.v_adh/c.v_yield,c.v_n/c.v_stick,b.energy_defect,b.steps);}
  }
  println!("worst {worst:e} {:?}",t.elapsed());
}

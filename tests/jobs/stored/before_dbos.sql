BEGIN TRANSACTION;
CREATE TABLE subt_checks (
	id VARCHAR(64) NOT NULL, 
	upload TEXT NOT NULL, 
	name TEXT NOT NULL, 
	profile TEXT NOT NULL, 
	stage VARCHAR(16) NOT NULL, 
	words TEXT NOT NULL, 
	created DOUBLE NOT NULL, 
	expires DOUBLE NOT NULL, 
	result TEXT NOT NULL, 
	packages JSON NOT NULL, 
	worker TEXT NOT NULL, 
	turn INTEGER NOT NULL, 
	losses JSON NOT NULL, 
	secret TEXT DEFAULT '' NOT NULL, 
	sender VARCHAR(64) DEFAULT '' NOT NULL, 
	cost DOUBLE DEFAULT '0' NOT NULL, 
	rank DOUBLE DEFAULT '0' NOT NULL, 
	tries INTEGER DEFAULT '0' NOT NULL, 
	not_before DOUBLE DEFAULT '0' NOT NULL, 
	PRIMARY KEY (id)
);
INSERT INTO "subt_checks" VALUES('15f944d7fdb04ff3c7d30d8c119fc3a846ffa80558d5c6b8c62c7fbaeecd2f61','e43411d260ec2f339696dde1a7ea3d8d344983a01f4c688ce91493c260c095f9','done.zip','','done','Ready: no error',1.79580800488901138308e+09,1.79840000488901138302e+09,'38d67e45e2d5f00919a70ab00f0cb8e61bb038416a827b3ddd0bebd402d64ef9','[{"name": "quick", "verdict": "ready", "errors": 0, "warnings": 1, "infos": 2, "folder": "", "kind": "robot"}]','',0,'[]','2bc1d41ed3178dc0d7a3a9773f85b3cdb13ffdc33c2022ab2747e1b818005967','',3.0,3.0,0,0.0);
INSERT INTO "subt_checks" VALUES('1b422a388397efea865dcaba443c6f78aa709e681687f4d735d3fbc4f6b0099a','de595d8a2d01519f445d70a159d384d20632a3e224cedd6576c0b217ef283cb3','refused.zip','refused','refused','robot.zip is not an archive',1.79580800810198926925e+09,1.79840000810198926924e+09,'','[]','',0,'[]','cf364f9784fa3ee35412358f74ab098003a65ea151a339e4f56bb5f69056b59e','',0.5000055,1.0000095,0,0.0);
INSERT INTO "subt_checks" VALUES('98951c90d131b9527ffb40d18cef0951ef97f4aa312a2559e278c15b07fc1235','baaeb6be8964e9ebb9e80b3ebbff65eeb312e9510ac342e85a8ac6526999efef','failed.zip','died','failed','the checker could not finish: it needs more than 4 GB of memory',1.79580800837199401859e+09,1.79840000837199401858e+09,'','[]','',0,'[]','165c3a0a9194d9699551730cfbc40e1698adfce1bfe8276921e0122e97616e88','',0.500005,1.5000145,0,0.0);
INSERT INTO "subt_checks" VALUES('6df479c09e53a7bda0a7dba712abcc714eb4cc03c4b036be7b47b3b91454a597','10fd8ae23cc2b82e1e81492a5cccd6bc9adf021a1d5c41bb9e6efa40b5ed55e3','cancelled.zip','static:60','cancelled','cancelled',1.79580800852600622175e+09,1.79840000852600622174e+09,'','[]','',0,'[]','6e1bc93f5511f8c3760a8f1edf75360efe4d0df40a0d98300875eae6a01197d0','',0.5000065,2.0000210000000002708e+00,0,0.0);
INSERT INTO "subt_checks" VALUES('1331983c04a28c2efe7a5db702457eb6793eeadd5d156732356bb846573038f8','5aadee61d1e2817d5aef5de5708192b8b19730564bb09833f80d7d073d8af349','tried.zip','trial:60','trial','the trial is running',1.79580800861600780489e+09,1.79840000861600780488e+09,'da9d3ff4a3beda9921239c82daec90b4e626c69cb72fe48430778772f061bf3d','[{"name": "quick", "verdict": "ready", "errors": 0, "warnings": 1, "infos": 2, "folder": "", "kind": "robot"}]','old-1',0,'[]','7b86a50461ffa63aeb81ce497368d3dadfdbab417ba7265ef90b2987ecec2868','sender',3.0,6.0,0,0.0);
INSERT INTO "subt_checks" VALUES('18043623302f57cdec3dbe342d43151a16aaae5230a5d5ae5074c925fd247f92','6dec4236784152244d34a755bb77230de6f78ce2990bfb57c6ca2b19adf84c57','waits.zip','','queued','waiting in the queue',1.79580800887901186947e+09,1.79840000887901186946e+09,'','[]','',0,'[]','f6405928a3ff7b9119e881a62e02c78f221e5dd6e5322447fe72048299db74e8','sender',0.5000045,2.5000235,0,0.0);
CREATE TABLE subt_events (
	check_id VARCHAR(64) NOT NULL, 
	number INTEGER NOT NULL, 
	"key" VARCHAR(32) NOT NULL, 
	stage VARCHAR(16) NOT NULL, 
	words TEXT NOT NULL, 
	time DOUBLE NOT NULL, 
	data JSON NOT NULL, 
	PRIMARY KEY (check_id, number), 
	UNIQUE (check_id, "key")
);
INSERT INTO "subt_events" VALUES('15f944d7fdb04ff3c7d30d8c119fc3a846ffa80558d5c6b8c62c7fbaeecd2f61',1,'queued','queued','waiting in the queue',1.79580800490200662611e+09,'{}');
INSERT INTO "subt_events" VALUES('15f944d7fdb04ff3c7d30d8c119fc3a846ffa80558d5c6b8c62c7fbaeecd2f61',2,'static','static','the static rules are running',1795808007.807,'{}');
INSERT INTO "subt_events" VALUES('15f944d7fdb04ff3c7d30d8c119fc3a846ffa80558d5c6b8c62c7fbaeecd2f61',3,'read','trial','the static rules are finished; the trial is waiting in the queue',1.79580800788798928256e+09,'{"result": "01b88d518cb7452f9a97f9004726c22847bbc317a6f20667ab0df60abf3338ab"}');
INSERT INTO "subt_events" VALUES('15f944d7fdb04ff3c7d30d8c119fc3a846ffa80558d5c6b8c62c7fbaeecd2f61',4,'trial','trial','the trial is running',1.79580800790999674798e+09,'{}');
INSERT INTO "subt_events" VALUES('15f944d7fdb04ff3c7d30d8c119fc3a846ffa80558d5c6b8c62c7fbaeecd2f61',5,'end','done','Ready: no error',1.79580800800699901583e+09,'{"result": "38d67e45e2d5f00919a70ab00f0cb8e61bb038416a827b3ddd0bebd402d64ef9"}');
INSERT INTO "subt_events" VALUES('1b422a388397efea865dcaba443c6f78aa709e681687f4d735d3fbc4f6b0099a',1,'queued','queued','waiting in the queue',1.79580800810299515721e+09,'{}');
INSERT INTO "subt_events" VALUES('1b422a388397efea865dcaba443c6f78aa709e681687f4d735d3fbc4f6b0099a',2,'static','static','the static rules are running',1.79580800817899560923e+09,'{}');
INSERT INTO "subt_events" VALUES('1b422a388397efea865dcaba443c6f78aa709e681687f4d735d3fbc4f6b0099a',3,'end','refused','robot.zip is not an archive',1.7958080083079829216e+09,'{}');
INSERT INTO "subt_events" VALUES('98951c90d131b9527ffb40d18cef0951ef97f4aa312a2559e278c15b07fc1235',1,'queued','queued','waiting in the queue',1.79580800837199401859e+09,'{}');
INSERT INTO "subt_events" VALUES('98951c90d131b9527ffb40d18cef0951ef97f4aa312a2559e278c15b07fc1235',2,'static','static','the static rules are running',1.79580800841198563568e+09,'{}');
INSERT INTO "subt_events" VALUES('98951c90d131b9527ffb40d18cef0951ef97f4aa312a2559e278c15b07fc1235',3,'end','failed','the checker could not finish: it needs more than 4 GB of memory',1.79580800843998789791e+09,'{}');
INSERT INTO "subt_events" VALUES('6df479c09e53a7bda0a7dba712abcc714eb4cc03c4b036be7b47b3b91454a597',1,'queued','queued','waiting in the queue',1.7958080085270121097e+09,'{}');
INSERT INTO "subt_events" VALUES('6df479c09e53a7bda0a7dba712abcc714eb4cc03c4b036be7b47b3b91454a597',2,'end','cancelled','cancelled',1.79580800854101324082e+09,'{}');
INSERT INTO "subt_events" VALUES('1331983c04a28c2efe7a5db702457eb6793eeadd5d156732356bb846573038f8',1,'queued','queued','waiting in the queue',1.79580800861600780489e+09,'{}');
INSERT INTO "subt_events" VALUES('1331983c04a28c2efe7a5db702457eb6793eeadd5d156732356bb846573038f8',2,'static','static','the static rules are running',1.7958080086510107517e+09,'{}');
INSERT INTO "subt_events" VALUES('1331983c04a28c2efe7a5db702457eb6793eeadd5d156732356bb846573038f8',3,'read','trial','the static rules are finished; the trial is waiting in the queue',1.79580800872399353983e+09,'{"result": "da9d3ff4a3beda9921239c82daec90b4e626c69cb72fe48430778772f061bf3d"}');
INSERT INTO "subt_events" VALUES('1331983c04a28c2efe7a5db702457eb6793eeadd5d156732356bb846573038f8',4,'trial','trial','the trial is running',1.79580800876100802419e+09,'{}');
INSERT INTO "subt_events" VALUES('18043623302f57cdec3dbe342d43151a16aaae5230a5d5ae5074c925fd247f92',1,'queued','queued','waiting in the queue',1.79580800888001775742e+09,'{}');
CREATE TABLE subt_queues (
	stage VARCHAR(16) NOT NULL, 
	moment DOUBLE NOT NULL, 
	PRIMARY KEY (stage)
);
INSERT INTO "subt_queues" VALUES('static',2.000019);
INSERT INTO "subt_queues" VALUES('trial',6.0);
CREATE TABLE subt_workers (
	name VARCHAR(128) NOT NULL, 
	beat DOUBLE NOT NULL, 
	layers JSON, 
	host TEXT, 
	PRIMARY KEY (name)
);
INSERT INTO "subt_workers" VALUES('old-1',1.79580800857501029967e+09,'[]','here');
CREATE INDEX ix_subt_checks_stage ON subt_checks (stage);
CREATE INDEX ix_subt_checks_expires ON subt_checks (expires);
COMMIT;